#include "cli/compare_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <pah/io/image_file.hpp>

namespace pah::cli {

ExitCode run_compare(const CompareArguments& arguments) {
  const ImageDifference difference =
      compare_images(read_image(arguments.a), read_image(arguments.b));
  if (arguments.json)
    fmt::print("{}\n",
               nlohmann::ordered_json{
                   {"mse", difference.mse}, {"relmse", difference.relmse}, {"max", difference.max}}
                   .dump(2));
  else
    fmt::print("mse    {:.6g}\nrelmse {:.6g}\nmax    {:.6g}\n", difference.mse, difference.relmse,
               difference.max);
  // Not `max > threshold`: a picture with NaNs must not pass.
  if (arguments.threshold && !(difference.max <= *arguments.threshold)) return ExitCode::failed;
  return ExitCode::done;
}

}  // namespace pah::cli
