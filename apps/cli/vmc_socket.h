#pragma once
// UDP as a relay needs it.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <netinet/in.h>

#include "base/result.h"

namespace panache::cli {

// "192.168.1.20:39540", "puppet.local:39540", or "39540" of `default_host`. The host is
// looked up. The message of a failure begins with `option`.
Result<sockaddr_in> parse_address(const std::string& text, const std::string& option,
                                  const std::string& default_host = "127.0.0.1");
// "127.0.0.1:39540"
std::string to_string(const sockaddr_in& address);
// The same, or "port 39539" of all of the machine's addresses.
std::string listened_at(const sockaddr_in& address);
// The same machine and port.
bool same_address(const sockaddr_in& a, const sockaddr_in& b);

// Seconds of the clock that datagrams are stamped with.
double stamp_now();

struct Datagram {
  std::vector<char> bytes;
  sockaddr_in sender{};
  double received = 0;  // When the machine got it, see stamp_now().
};

// An IPv4 socket; closed at the end of its life.
class UdpSocket {
 public:
  // Listens at an address of this machine, or at all of them (0.0.0.0), with room for about a
  // second of datagrams.
  static Result<UdpSocket> listen(const sockaddr_in& address, const std::string& option);
  // Only sends.
  static Result<UdpSocket> open();

  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&&) = delete;
  ~UdpSocket();

  int file() const { return file_; }  // For poll().
  // The next datagram if one waits.
  std::optional<Datagram> receive();
  // False where the machine does not take it.
  bool send(std::span<const char> bytes, const sockaddr_in& to);
  // Datagrams that came and found no room, as far as the machine tells.
  uint32_t lost() const { return lost_; }

 private:
  explicit UdpSocket(int file) : file_(file), buffer_(1 << 16) {}

  int file_;
  std::vector<char> buffer_;  // The largest datagram fits.
  uint32_t lost_ = 0;
};

}  // namespace panache::cli
