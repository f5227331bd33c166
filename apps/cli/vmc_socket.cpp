#include "vmc_socket.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <memory>
#include <utility>

#include <arpa/inet.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include "clip/text_cursor.h"

namespace panache::cli {
namespace {

constexpr int kRoom = 1 << 22;  // Bytes; three senders at 90 Hz fill a quarter per second.

double seconds_of(const timespec& time) {
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void switch_on(int file, int option) {
  const int on = 1;
  ::setsockopt(file, SOL_SOCKET, option, &on, sizeof on);
}

}  // namespace

Result<sockaddr_in> parse_address(const std::string& text, const std::string& option,
                                  const std::string& default_host) {
  const size_t colon = text.rfind(':');
  const std::string host = colon == std::string::npos ? default_host : text.substr(0, colon);
  const std::string digits = colon == std::string::npos ? text : text.substr(colon + 1);
  uint16_t port = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, wrong] = std::from_chars(digits.data(), end, port);
  if (wrong != std::errc() || stop != end || port == 0) {
    return Error{option + ": expected a port from 1 to 65535, found " + panache::quoted(digits)};
  }
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* list = nullptr;
  const int failure = ::getaddrinfo(host.c_str(), nullptr, &wanted, &list);
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> found(failure ? nullptr : list,
                                                                   &::freeaddrinfo);
  if (!found) {
    return Error{option + ": the host " + panache::quoted(host) +
                 " is not known: " + ::gai_strerror(failure)};
  }
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof address);
  address.sin_port = htons(port);
  return address;
}

std::string to_string(const sockaddr_in& address) {
  char host[INET_ADDRSTRLEN] = "";
  ::inet_ntop(AF_INET, &address.sin_addr, host, sizeof host);
  return std::string(host) + ":" + std::to_string(ntohs(address.sin_port));
}

std::string listened_at(const sockaddr_in& address) {
  if (address.sin_addr.s_addr != htonl(INADDR_ANY)) return to_string(address);
  return "port " + std::to_string(ntohs(address.sin_port));
}

bool same_address(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

double stamp_now() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);  // The clock of SO_TIMESTAMPNS.
  return seconds_of(now);
}

Result<UdpSocket> UdpSocket::open() {
  const int file = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (file < 0) return Error{std::string("cannot create a socket: ") + std::strerror(errno)};
  return UdpSocket(file);
}

Result<UdpSocket> UdpSocket::listen(const sockaddr_in& address, const std::string& option) {
  Result<UdpSocket> socket = open();
  if (!socket) return socket;
  const int file = socket->file();
  ::setsockopt(file, SOL_SOCKET, SO_RCVBUF, &kRoom, sizeof kRoom);
  switch_on(file, SO_TIMESTAMPNS);
  switch_on(file, SO_RXQ_OVFL);
  if (::bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return Error{option + ": cannot listen at " + listened_at(address) + ": " +
                 std::strerror(errno)};
  }
  return socket;
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      buffer_(std::move(other.buffer_)),
      lost_(other.lost_) {}

UdpSocket::~UdpSocket() {
  if (file_ >= 0) ::close(file_);
}

std::optional<Datagram> UdpSocket::receive() {
  Datagram out;
  iovec part = {buffer_.data(), buffer_.size()};
  alignas(cmsghdr) char control[256];
  msghdr head{};
  head.msg_name = &out.sender;
  head.msg_namelen = sizeof out.sender;
  head.msg_iov = &part;
  head.msg_iovlen = 1;
  head.msg_control = control;
  head.msg_controllen = sizeof control;
  const ssize_t size = ::recvmsg(file_, &head, 0);
  if (size < 0) return std::nullopt;
  out.received = stamp_now();
  for (cmsghdr* note = CMSG_FIRSTHDR(&head); note; note = CMSG_NXTHDR(&head, note)) {
    if (note->cmsg_level != SOL_SOCKET) continue;
    if (note->cmsg_type == SO_RXQ_OVFL) std::memcpy(&lost_, CMSG_DATA(note), sizeof lost_);
    if (note->cmsg_type == SCM_TIMESTAMPNS) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(note), sizeof time);
      out.received = seconds_of(time);
    }
  }
  out.bytes.assign(buffer_.begin(), buffer_.begin() + size);
  return out;
}

bool UdpSocket::send(std::span<const char> bytes, const sockaddr_in& to) {
  return ::sendto(file_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
                  sizeof to) == static_cast<ssize_t>(bytes.size());
}

}  // namespace panache::cli
