#pragma once
// The relay from a socket to an address, with one character per sender.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "person_options.h"
#include "vmc_character.h"
#include "vmc_socket.h"

namespace panache::cli {

// A histogram of how long datagrams stay in the relay, in microseconds, of fixed size; 10 ms and
// more count as one.
class VmcLatencies {
 public:
  void add(double seconds);
  // The percentile at `share` (0 to 1), microseconds; 0 if empty.
  int quantile_us(double share) const;

 private:
  static constexpr int kMax = 10'000;
  std::array<uint32_t, kMax + 1> counts_{};  // [microseconds]
  uint64_t all_ = 0;
};

// Counts for a second or for the whole run.
struct VmcCounts {
  int64_t frames = 0;    // Of all senders.
  int64_t lost = 0;      // Datagrams dropped for lack of buffer space, received or sent.
  int64_t rejected = 0;  // Datagrams that are not OSC.
  VmcLatencies latencies;
};

class VmcRelay {
 public:
  // strengths: one per style of the model. `person`: of the senders; a random one is another one
  // for each, by their order.
  VmcRelay(UdpSocket socket, const sockaddr_in& to, VmcStyling styling,
           std::vector<float> strengths, std::optional<PersonWish> person);

  // Waits briefly for datagrams and sends those that are ready.
  void run_once();
  // Sends all held datagrams.
  void finish();

  const VmcCounts& all() const { return all_; }
  size_t senders() const { return met_; }  // So far.
  // "270 frames of 3 senders, 0 lost, p50 85 us, p99 210 us, old 1": since the last call. Empty if
  // nothing has been received.
  std::string second();
  // The last message for the user since the last call, or empty.
  std::string take_note() { return std::exchange(note_, {}); }

 private:
  struct Sender {
    sockaddr_in address;
    double heard;  // Time of the last datagram.
    bool this_second;
    VmcCharacter character;
  };
  static constexpr size_t kMaxSenders = 16;

  void take(Datagram datagram);
  void apply_command(const VmcMessage& message);
  void apply_side(const VmcMessage& message);
  VmcCharacter make_character();
  // Null if the sender is new and `meet` is false.
  Sender* sender_of(const Datagram& datagram, bool meet);
  // Sends all held datagrams of a sender, even of an incomplete frame.
  void send_rest(Sender& sender);
  void send_ready(Sender& sender);
  void send(const Datagram& datagram);

  UdpSocket socket_;
  sockaddr_in to_;
  VmcStyling styling_;
  std::vector<float> strengths_;  // [styles]
  std::optional<PersonWish> person_;
  std::vector<Sender> senders_;
  size_t met_ = 0;
  uint32_t lost_before_ = 0;
  VmcCounts all_, second_;
  std::string note_;
};

}  // namespace panache::cli
