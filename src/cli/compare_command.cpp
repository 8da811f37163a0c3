#include "cli/compare_command.hpp"

#include <fmt/format.h>

#include <pah/image/compare.hpp>
#include <pah/image/image_file.hpp>

#include "report/json.hpp"

namespace pah::cli {

ExitCode run_compare(const CompareArguments& arguments) {
  const ImageDifference difference =
      compare_images(read_image(arguments.a), read_image(arguments.b));
  if (arguments.json)
    fmt::print(
        "{}\n",
        text_of({{"mse", difference.mse}, {"relmse", difference.relmse}, {"max", difference.max}}));
  else
    fmt::print("mse    {:.6g}\nrelmse {:.6g}\nmax    {:.6g}\n", difference.mse, difference.relmse,
               difference.max);
  // `max > threshold` would let a picture with NaNs pass.
  if (arguments.threshold && !(difference.max <= *arguments.threshold)) return ExitCode::failed;
  return ExitCode::done;
}

}  // namespace pah::cli
