#pragma once
// The relay itself: from a socket to an address, a character for each sender.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "vmc_character.h"
#include "vmc_socket.h"

namespace panache::cli {

// How long datagrams stay in the relay: microseconds, all from 10 ms on as one, so that any number
// of them takes the same room.
class VmcLatencies {
 public:
  void add(double seconds);
  // The microseconds that `share` (0 to 1) of them do not exceed; 0 of none.
  int quantile_us(double share) const;

 private:
  static constexpr int kMax = 10'000;
  std::array<uint32_t, kMax + 1> counts_{};  // [microseconds]
  uint64_t all_ = 0;
};

// Counts of a second, or of all.
struct VmcCounts {
  int64_t frames = 0;    // Of all senders.
  int64_t lost = 0;      // Datagrams that found no room on the way in or out.
  int64_t rejected = 0;  // Datagrams that are no OSC.
  VmcLatencies latencies;
};

class VmcRelay {
 public:
  // strengths: one per style of the model.
  VmcRelay(UdpSocket socket, const sockaddr_in& to, VmcStyling how, std::vector<float> strengths);

  // Waits for datagrams a little while and sends on what is ready.
  void run_once();
  // Sends on what still waits.
  void finish();

  const VmcCounts& all() const { return all_; }
  size_t senders() const { return met_; }  // So far.
  // "270 frames of 3 senders, 0 lost, p50 85 us, p99 210 us, old 1": since this was last asked.
  std::string second();
  // What a user should know, since this was last asked; the last such message, or empty.
  std::string take_note() { return std::exchange(note_, {}); }

 private:
  struct Sender {
    sockaddr_in address;
    double heard;  // When last.
    bool this_second;
    VmcCharacter character;
  };
  static constexpr size_t kMaxSenders = 16;

  void take(Datagram datagram);
  void apply_command(const VmcMessage& message);
  // Null where the sender is new and not to be met.
  Sender* sender_of(const Datagram& datagram, bool meet);
  // All that waits of a sender, whole or begun.
  void send_rest(Sender& sender);
  void send_ready(Sender& sender);
  void send(const Datagram& datagram);

  UdpSocket socket_;
  sockaddr_in to_;
  VmcStyling how_;
  std::vector<float> strengths_;  // [styles]
  std::vector<Sender> senders_;
  size_t met_ = 0;
  uint32_t lost_before_ = 0;
  VmcCounts all_, second_;
  std::string note_;
};

}  // namespace panache::cli
