#include "cli/tev/connection.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace pah::cli {
namespace {

constexpr std::chrono::milliseconds between_tries(20);

struct FreeAddresses {
  void operator()(addrinfo* addresses) const { ::freeaddrinfo(addresses); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

std::runtime_error failure(int error) {
  return std::runtime_error(std::generic_category().message(error));
}

// Returns an error of getaddrinfo, 0 for none.
int look_up(const TevAddress& address, int flags, Addresses& found) {
  addrinfo hints{};
  hints.ai_flags = flags | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* addresses = nullptr;
  const int error =
      ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &addresses);
  found.reset(addresses);
  return error;
}

// A name lookup can take long and cannot be cancelled. A detached thread does it, so that the
// caller can stop waiting. Numeric addresses need no thread.
Addresses resolve(const TevAddress& address, const TevConnection::OutOfTime& out_of_time) {
  Addresses numbers;
  if (look_up(address, AI_NUMERICHOST, numbers) == 0) return numbers;
  std::packaged_task<Addresses()> task([address] {
    Addresses found;
    if (const int error = look_up(address, 0, found); error != 0)
      throw std::runtime_error(::gai_strerror(error));
    return found;
  });
  std::future<Addresses> found = task.get_future();
  std::thread(std::move(task)).detach();
  while (found.wait_for(between_tries) != std::future_status::ready)
    if (out_of_time()) throw std::runtime_error("the lookup of its name timed out");
  return found.get();
}

// Returns false on a timeout.
bool wait_for(int socket, short events, const TevConnection::OutOfTime& out_of_time) {
  pollfd waiting{socket, events, 0};
  while (::poll(&waiting, 1, static_cast<int>(between_tries.count())) <= 0)
    if (out_of_time()) return false;
  return true;
}

// Returns the error of the last operation on the socket, 0 for none.
int pending_error(int socket) {
  int error = 0;
  socklen_t size = sizeof(error);
  return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

// Returns an error, 0 for none.
int connect_to(const addrinfo& address, int socket, const TevConnection::OutOfTime& out_of_time) {
  if (::connect(socket, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  return wait_for(socket, POLLOUT, out_of_time) ? pending_error(socket) : ETIMEDOUT;
}

}  // namespace

TevConnection::TevConnection(const TevAddress& address, const OutOfTime& out_of_time) {
  const Addresses addresses = resolve(address, out_of_time);
  int error = EADDRNOTAVAIL;
  for (const addrinfo* at = addresses.get(); at != nullptr; at = at->ai_next) {
    const int socket = ::socket(at->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    error = socket == -1 ? errno : connect_to(*at, socket, out_of_time);
    if (error == 0) {
      socket_ = socket;
      return;
    }
    if (socket != -1) ::close(socket);
  }
  throw failure(error);
}

TevConnection::~TevConnection() { ::close(socket_); }

bool TevConnection::send(std::string_view bytes, const OutOfTime& out_of_time) {
  // Without this check the system would accept one write to a viewer that has hung up.
  pollfd other_side{socket_, POLLRDHUP, 0};
  if (::poll(&other_side, 1, 0) > 0) {
    const int error = pending_error(socket_);
    throw failure(error == 0 ? EPIPE : error);
  }
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)
      throw failure(errno);
    // The time limit also holds if the viewer reads a little now and then.
    if (out_of_time() && !bytes.empty()) return false;
    if (sent < 0 && !wait_for(socket_, POLLOUT, out_of_time)) return false;
  }
  return true;
}

void TevConnection::finish(const OutOfTime& out_of_time) {
  if (::shutdown(socket_, SHUT_WR) != 0) throw failure(errno);
  std::array<char, 256> reply{};  // ignored
  while (wait_for(socket_, POLLIN, out_of_time)) {
    const ssize_t count = ::recv(socket_, reply.data(), reply.size(), 0);
    if (count < 0 && errno != EAGAIN && errno != EINTR) throw failure(errno);
    if (count == 0) {
      // The viewer may have hung up before it read everything.
      if (const int error = pending_error(socket_); error != 0) throw failure(error);
      return;
    }
  }
}

}  // namespace pah::cli
