// Runs the built program as a shell would.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace pah::test {

// Returns the sorted names in the current folder, without the files of captured streams.
[[nodiscard]] std::vector<std::string> files();

void write_file(const std::string& name, const std::string& text);
[[nodiscard]] std::string read_file(const std::string& name);
[[nodiscard]] bool contains(const std::string& text, const std::string& part);

struct Outcome {
  int exit_code = -1;  // -1 if a signal ended it
  std::string out, err;
};

// A dumb terminal, by TERM=dumb, can only print.
enum class ErrorStream { file, terminal, dumb_terminal, full, closed };

// A running program. Its streams go to files in the current folder.
class Program {
 public:
  explicit Program(const std::vector<std::string>& arguments,
                   ErrorStream stream = ErrorStream::file);
  ~Program();  // kills it if it still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void signal(int number) const;
  // Returns false if the program ends or 60 seconds pass without the text. The stream must be a
  // terminal.
  [[nodiscard]] bool wait_for_error_text(const std::string& text);
  Outcome wait();

 private:
  bool read_terminal();  // false at its end

  pid_t pid_ = -1;
  int terminal_ = -1;
  std::string terminal_text_;
};

[[nodiscard]] Outcome run(const std::vector<std::string>& arguments,
                          ErrorStream stream = ErrorStream::file);

// A box on a floor under a lamp: has every kind of ray, and renders fast.
extern const char* const small_scene;

}  // namespace pah::test
