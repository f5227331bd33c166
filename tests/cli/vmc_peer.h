#pragma once
// A tracker or an avatar for tests of the VMC protocol. OSC is written and read here anew, so that
// the program does not agree with its own mistakes only.

#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/quat.h"
#include "base/vec.h"

namespace panache::test {

using Bytes = std::string;

// A UDP socket of this machine at any free port.
class Peer {
 public:
  Peer() : file_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = at(0);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(file_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(::getsockname(file_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  Peer(const Peer&) = delete;
  ~Peer() { ::close(file_); }

  uint16_t port() const { return port_; }
  std::string port_name() const { return std::to_string(port_); }
  // To this machine, at the address 127.0.0.`host`.
  void send(uint16_t port, const Bytes& bytes, uint32_t host = 1) const {
    const sockaddr_in to = at(port, host);
    ::sendto(file_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
  }
  std::optional<Bytes> receive(int milliseconds) const {
    pollfd waiting = {file_, POLLIN, 0};
    if (::poll(&waiting, 1, milliseconds) <= 0) return std::nullopt;
    Bytes bytes(1 << 16, '\0');
    const ssize_t size = ::recv(file_, bytes.data(), bytes.size(), 0);
    bytes.resize(size < 0 ? 0 : static_cast<size_t>(size));
    return bytes;
  }

 private:
  static sockaddr_in at(uint16_t port, uint32_t host = 1) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl((INADDR_LOOPBACK & ~0xffu) | host);
    address.sin_port = htons(port);
    return address;
  }

  int file_;
  uint16_t port_ = 0;
};

inline Bytes osc(uint32_t number) {
  Bytes out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(number >> shift);
  return out;
}
inline Bytes osc(float number) { return osc(std::bit_cast<uint32_t>(number)); }
inline Bytes osc(const std::string& text) { return text + Bytes(4 - text.size() % 4, '\0'); }
inline Bytes bundle(const std::vector<Bytes>& elements) {
  Bytes out = osc("#bundle") + osc(0u) + osc(1u);
  for (const Bytes& element : elements) out += osc(static_cast<uint32_t>(element.size())) + element;
  return out;
}
inline Bytes bone_message(const std::string& name, float x = 0, float y = 0, float w = 1) {
  Bytes out = osc("/VMC/Ext/Bone/Pos") + osc(",sfffffff") + osc(name);
  for (const float number : {x, y, 0.0f, 0.0f, 0.0f, 0.0f, w}) out += osc(number);
  return out;
}
inline Bytes blend_message(float value) {
  return osc("/VMC/Ext/Blend/Val") + osc(",sf") + osc("Joy") + osc(value);
}
inline Bytes style_message(const std::string& name, float strength) {
  return osc("/panache/style") + osc(",sf") + osc(name) + osc(strength);
}

inline uint32_t number_at(const Bytes& bytes, size_t at) {
  uint32_t out = 0;
  for (size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return out;
}
// The messages of a valid bundle, or a valid message itself.
inline std::vector<Bytes> messages_of(const Bytes& datagram) {
  if (datagram[0] == '/') return {datagram};
  std::vector<Bytes> out;
  for (size_t at = 16; at < datagram.size(); at += 4 + number_at(datagram, at)) {
    out.push_back(datagram.substr(at + 4, number_at(datagram, at)));
  }
  return out;
}

struct Bone {
  Vec3 position;
  Quat rotation;
};
// The bones and the root ("root") in a valid datagram, in Unity's axes.
inline std::map<std::string, Bone> bones_of(const Bytes& datagram) {
  std::map<std::string, Bone> out;
  for (const Bytes& message : messages_of(datagram)) {
    if (!message.starts_with("/VMC/Ext/Bone/Pos") && !message.starts_with("/VMC/Ext/Root/Pos")) {
      continue;
    }
    const std::string name = message.c_str() + 32;
    float n[7];
    for (size_t i = 0; i < 7; ++i) {
      n[i] = std::bit_cast<float>(number_at(message, 32 + osc(name).size() + 4 * i));
    }
    out[name] = {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}};
  }
  return out;
}

}  // namespace panache::test
