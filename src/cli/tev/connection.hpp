// A TCP connection to an image viewer, used for writing only.
#pragma once

#include <functional>
#include <string_view>

#include "cli/tev/address.hpp"

namespace pah::cli {

class TevConnection {
 public:
  // Returns whether to stop waiting; called several times in a tenth of a second while waiting.
  using OutOfTime = std::function<bool()>;

  // Throws std::runtime_error with the reason if nobody answers in time.
  TevConnection(const TevAddress& address, const OutOfTime& out_of_time);
  ~TevConnection();
  TevConnection(const TevConnection&) = delete;
  TevConnection& operator=(const TevConnection&) = delete;

  // Returns false if the viewer did not accept everything in time. It then holds a partial packet,
  // and nothing more can be sent. Throws std::runtime_error if the connection is lost.
  [[nodiscard]] bool send(std::string_view bytes, const OutOfTime& out_of_time);

  // Closes the sending side and waits until the viewer has read everything and hangs up, or until
  // the timeout; the system then delivers the remainder. Throws std::runtime_error if the
  // connection was lost before.
  void finish(const OutOfTime& out_of_time);

 private:
  int socket_ = -1;
};

}  // namespace pah::cli
