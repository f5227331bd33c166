#pragma once
// UDP sockets for the relay.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <netinet/in.h>

#include "base/result.h"

namespace panache::cli {

// "192.168.1.20:39540", "puppet.local:39540", or "39540" on `default_host`. Resolves the host.
// Failure messages begin with `option`.
Result<sockaddr_in> parse_address(const std::string& text, const std::string& option,
                                  const std::string& default_host = "127.0.0.1");
// "127.0.0.1:39540"
std::string to_string(const sockaddr_in& address);
// The same, or "port 39539" for all addresses of the machine.
std::string listened_at(const sockaddr_in& address);
// Whether host and port are equal.
bool same_address(const sockaddr_in& a, const sockaddr_in& b);

// The current time of the clock that stamps datagrams, in seconds.
double stamp_now();

struct Datagram {
  std::vector<char> bytes;
  sockaddr_in sender{};
  double received = 0;  // Time of receipt by the system, see stamp_now().
};

// An IPv4 socket, closed by its destructor.
class UdpSocket {
 public:
  // Listens on one address of this machine or on all (0.0.0.0), and buffers about a second of
  // datagrams.
  static Result<UdpSocket> listen(const sockaddr_in& address, const std::string& option);
  // A socket for sending only.
  static Result<UdpSocket> open();

  UdpSocket(UdpSocket&& other) noexcept;
  UdpSocket& operator=(UdpSocket&&) = delete;
  ~UdpSocket();

  int file() const { return file_; }  // For poll().
  // The next datagram, if one has arrived.
  std::optional<Datagram> receive();
  // False if the system rejects it.
  bool send(std::span<const char> bytes, const sockaddr_in& to);
  // The number of received datagrams dropped for lack of buffer space, if the system reports it.
  uint32_t lost() const { return lost_; }

 private:
  explicit UdpSocket(int file) : file_(file), buffer_(1 << 16) {}

  int file_;
  std::vector<char> buffer_;  // Fits the largest datagram.
  uint32_t lost_ = 0;
};

}  // namespace panache::cli
