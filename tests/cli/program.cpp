#include "program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/paths.hpp"

namespace pah::test {

namespace fs = std::filesystem;

const char* const small_scene = R"(
camera: {type: perspective, position: [2, 2, 4], look_at: [0, 0.3, 0], fov: 45}
film: {width: 32, height: 24}
render: {samples: 4, max_depth: 4, seed: 3}
materials:
  white: {type: diffuse, reflectance: [0.8, 0.7, 0.6]}
meshes:
  - {name: floor, shape: rectangle, size: [6, 6], material: white}
  - {name: box, shape: box, size: [1, 1, 1], material: white, transform: [{translate: [0, 0.5, 0]}]}
lights:
  - {name: bulb, type: point, position: [1, 3, 1], intensity: [20, 20, 18]}
)";

std::vector<std::string> files() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(".")) {
    std::string name = entry.path().filename();
    if (name != "stdout" && name != "stderr") names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  return names;
}

void write_file(const std::string& name, const std::string& text) { std::ofstream(name) << text; }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string read_file(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(name).rdbuf();
  return text.str();
}

Program::Program(const std::vector<std::string>& arguments, ErrorStream stream) {
  std::vector<std::string> words{test::program()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const int in = ::open("/dev/null", O_RDONLY);
  const int out = ::open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  int error = -1;
  const bool dumb = stream == ErrorStream::dumb_terminal;
  if (dumb || stream == ErrorStream::terminal) {
    terminal_ = ::posix_openpt(O_RDWR | O_NOCTTY);
    if (terminal_ >= 0 && ::grantpt(terminal_) == 0 && ::unlockpt(terminal_) == 0)
      error = ::open(::ptsname(terminal_), O_RDWR | O_NOCTTY);
  } else {
    error = ::open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (stream == ErrorStream::full) {
      ::close(error);
      error = ::open("/dev/full", O_WRONLY);
    }
  }
  if (in < 0 || out < 0 || error < 0) throw std::runtime_error("cannot open streams");

  pid_ = ::fork();
  if (pid_ == 0) {
    ::dup2(in, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(error, STDERR_FILENO);
    for (const int file : {in, out, error, terminal_})
      if (file > STDERR_FILENO) ::close(file);
    ::setenv("TERM", dumb ? "dumb" : "xterm", 1);
    if (stream == ErrorStream::closed) ::close(STDERR_FILENO);
    ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
  for (const int file : {in, out, error}) ::close(file);
  if (pid_ < 0) throw std::runtime_error("cannot fork");
}

Program::~Program() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (terminal_ >= 0) ::close(terminal_);
}

void Program::signal(int number) const { ::kill(pid_, number); }

bool Program::read_terminal() {
  pollfd ready{terminal_, POLLIN, 0};
  if (::poll(&ready, 1, 100) <= 0) return true;
  std::array<char, 4096> buffer;
  const ssize_t count = ::read(terminal_, buffer.data(), buffer.size());
  if (count <= 0) return false;
  terminal_text_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

bool Program::wait_for_error_text(const std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto give_up = Clock::now() + std::chrono::seconds(60);
  while (terminal_text_.find(text) == std::string::npos)
    if (Clock::now() > give_up || !read_terminal()) return false;
  return true;
}

Outcome Program::wait() {
  // Reads the terminal to its end: a full one would block the program.
  while (terminal_ >= 0 && read_terminal()) {
  }
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file("stdout"),
          terminal_ >= 0 ? terminal_text_ : read_file("stderr")};
}

Outcome run(const std::vector<std::string>& arguments, ErrorStream stream) {
  return Program(arguments, stream).wait();
}

}  // namespace pah::test
