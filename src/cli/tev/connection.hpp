// A TCP connection to an image viewer, which is written to and never read from.
#pragma once

#include <functional>
#include <string_view>

#include "cli/tev/address.hpp"

namespace pah::cli {

class TevConnection {
 public:
  // Whether to wait no longer; asked every some hundredths of a second while there is waiting.
  using OutOfTime = std::function<bool()>;

  // Throws std::runtime_error, which says why, if nobody answers there in time.
  TevConnection(const TevAddress& address, const OutOfTime& out_of_time);
  ~TevConnection();
  TevConnection(const TevConnection&) = delete;
  TevConnection& operator=(const TevConnection&) = delete;

  // False if the other side did not take all of it in time; what it took is then no whole packet,
  // and no more can be sent. Throws std::runtime_error if the connection is lost.
  [[nodiscard]] bool send(std::string_view bytes, const OutOfTime& out_of_time);

  // Says that this was all, and waits until the other side has read it and hangs up, or until out
  // of time: what was sent is then left to the system. Throws std::runtime_error if the connection
  // was lost before.
  void finish(const OutOfTime& out_of_time);

 private:
  int socket_ = -1;
};

}  // namespace pah::cli
