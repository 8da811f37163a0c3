#include "cli/terminal/report_exception.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <pah/base/errors.hpp>

#include "cli/terminal/console.hpp"
#include "image/texture/store.hpp"

namespace pah::cli {

ExitCode report_exception() {
  try {
    throw;
  } catch (const UsageError& error) {
    say(fmt::format("pahrender: {}\nRun pahrender --help to see all options.\n", error.what()));
    return ExitCode::wrong_usage;
  } catch (const SceneError& errors) {
    for (const LocatedError& error : errors.errors()) say(fmt::format("{}\n", format_error(error)));
    return ExitCode::scene_error;
  } catch (const TextureError& error) {  // loading finds these unless the file changed since
    say(fmt::format("pahrender: {}\n", error.what()));
    return ExitCode::scene_error;
  } catch (const FileError& error) {
    say(fmt::format("pahrender: {}\n", error.what()));
    return ExitCode::file_error;
  } catch (const std::bad_alloc&) {
    say("pahrender: out of memory\n");
    return ExitCode::failed;
  } catch (const std::exception& error) {
    say(fmt::format("pahrender: {}\n", error.what()));
    return ExitCode::failed;
  }
}

}  // namespace pah::cli
