#include "vmc_relay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <poll.h>

#include "clip/text_cursor.h"
#include "messages.h"
#include "sides.h"
#include "strengths.h"

namespace panache::cli {
namespace {

constexpr int kWaitMilliseconds = 10;
// Limits a burst, so that held frames and statistics get their turn.
constexpr int kMaxAtOnce = 64;

bool is_command(const VmcMessage& message) {
  using enum VmcMessage::Kind;
  return message.kind == style || message.kind == VmcMessage::side || message.kind == reset;
}

}  // namespace

void VmcLatencies::add(double seconds) {
  // A clock that is set meanwhile may cause any value.
  const double us = std::clamp(std::ceil(1e6 * seconds), 0.0, double{kMax});
  ++counts_[static_cast<size_t>(us)];
  ++all_;
}

int VmcLatencies::quantile_us(double share) const {
  const auto wanted = static_cast<uint64_t>(std::ceil(share * static_cast<double>(all_)));
  uint64_t sum = 0;
  for (int us = 0; us <= kMax; ++us) {
    sum += counts_[static_cast<size_t>(us)];
    if (sum >= wanted) return us;
  }
  return kMax;
}

VmcRelay::VmcRelay(UdpSocket socket, const sockaddr_in& to, VmcStyling styling,
                   std::vector<float> strengths, std::optional<PersonWish> person)
    : socket_(std::move(socket)),
      to_(to),
      styling_(std::move(styling)),
      strengths_(std::move(strengths)),
      person_(std::move(person)) {
  senders_.reserve(kMaxSenders);
}

void VmcRelay::run_once() {
  pollfd waiting = {socket_.file(), POLLIN, 0};
  ::poll(&waiting, 1, kWaitMilliseconds);
  for (int i = 0; i < kMaxAtOnce; ++i) {
    std::optional<Datagram> datagram = socket_.receive();
    if (!datagram) break;
    take(*std::move(datagram));
  }
  for (Sender& sender : senders_) {
    sender.character.end_late_frame(stamp_now(), strengths_);
    send_ready(sender);
  }
  // The system's counter wraps around.
  const uint32_t lost = socket_.lost() - std::exchange(lost_before_, socket_.lost());
  all_.lost += lost;
  second_.lost += lost;
}

void VmcRelay::finish() {
  for (Sender& sender : senders_) send_rest(sender);
}

void VmcRelay::take(Datagram datagram) {
  const std::optional<std::vector<VmcMessage>> messages = read_vmc(datagram.bytes);
  if (!messages) {
    ++all_.rejected;
    ++second_.rejected;
    return;
  }
  for (const VmcMessage& message : *messages) apply_command(message);
  // Commands to this program are not sent to the avatar.
  if (!messages->empty() && std::all_of(messages->begin(), messages->end(), is_command)) return;
  const bool has_bones = std::any_of(messages->begin(), messages->end(), [](const VmcMessage& m) {
    return m.kind == VmcMessage::bone;
  });
  Sender* sender = sender_of(datagram, has_bones);
  if (!sender) {
    send(datagram);
    return;
  }
  sender->heard = datagram.received;
  sender->this_second = true;
  sender->character.take(std::move(datagram), *messages, strengths_);
  send_ready(*sender);
}

void VmcRelay::apply_command(const VmcMessage& message) {
  if (message.kind == VmcMessage::reset) {
    for (Sender& sender : senders_) sender.character.reset();
  }
  if (message.kind == VmcMessage::side) apply_side(message);
  if (message.kind != VmcMessage::style) return;
  const Result<int> style = styling_.model->find_style_by_any_name(message.name);
  const double strength = message.strength;
  if (!style) {
    note_ = with_hint(located("/panache/style", style.error()));
  } else if (!(strength >= double{kLowestStrength} && strength <= double{kHighestStrength})) {
    note_ = "/panache/style " + message.name + ": expected a strength from -4 to 4, found " +
            brief(strength);
  } else {
    strengths_[static_cast<size_t>(*style)] = static_cast<float>(strength);
  }
}

void VmcRelay::apply_side(const VmcMessage& message) {
  const Result<int> style = styling_.model->find_style_by_any_name(message.name);
  const Result<float> side =
      style ? read_side(*styling_.model, *style, message.side_text) : Result<float>(style.error());
  if (!side) {
    note_ = with_hint(located("/panache/side " + message.name, side.error()));
    return;
  }
  std::vector<float>& sides = styling_.options.stylizer.sides;
  sides.resize(styling_.model->styles().size(), 1.0f);
  sides[static_cast<size_t>(*style)] = *side;
  for (Sender& sender : senders_) sender.character.set_side(*style, *side);
}

VmcCharacter VmcRelay::make_character() {
  VmcStyling styling = styling_;
  if (person_) {
    const std::string sender = std::to_string(met_ + 1);
    styling.options.stylizer.person = person_->numbers_for(sender, *styling.model);
    note_ = "sender " + sender + " moves as " + person_->describe(sender);
  }
  return VmcCharacter(std::move(styling));
}

VmcRelay::Sender* VmcRelay::sender_of(const Datagram& datagram, bool meet) {
  for (Sender& sender : senders_) {
    if (same_address(sender.address, datagram.sender)) return &sender;
  }
  if (!meet) return nullptr;
  // A new sender replaces the one silent for longest, after sending what that one holds.
  if (senders_.size() == kMaxSenders) {
    const auto silent =
        std::min_element(senders_.begin(), senders_.end(),
                         [](const Sender& a, const Sender& b) { return a.heard < b.heard; });
    send_rest(*silent);
    senders_.erase(silent);
  }
  senders_.push_back({datagram.sender, datagram.received, true, make_character()});
  ++met_;
  return &senders_.back();
}

void VmcRelay::send_rest(Sender& sender) {
  sender.character.end_frame(strengths_);
  send_ready(sender);
}

void VmcRelay::send_ready(Sender& sender) {
  for (const Datagram& datagram : sender.character.take_ready()) send(datagram);
  const int frames = sender.character.take_frames();
  all_.frames += frames;
  second_.frames += frames;
  if (const std::string note = sender.character.take_note(); !note.empty()) {
    note_ = to_string(sender.address) + ": " + note + "; its motion is passed on unchanged";
  }
}

void VmcRelay::send(const Datagram& datagram) {
  if (!socket_.send(datagram.bytes, to_)) {
    ++all_.lost;
    ++second_.lost;
    return;
  }
  const double seconds = stamp_now() - datagram.received;
  all_.latencies.add(seconds);
  second_.latencies.add(seconds);
}

std::string VmcRelay::second() {
  size_t heard = 0;
  for (Sender& sender : senders_) heard += std::exchange(sender.this_second, false);
  if (heard == 0 && second_.frames == 0 && second_.lost == 0 && second_.rejected == 0) return "";
  std::string line = plural(static_cast<size_t>(second_.frames), "frame") + " of " +
                     plural(heard, "sender") + ", " + std::to_string(second_.lost) + " lost, p50 " +
                     std::to_string(second_.latencies.quantile_us(0.5)) + " us, p99 " +
                     std::to_string(second_.latencies.quantile_us(0.99)) + " us";
  if (second_.rejected > 0) line += ", " + std::to_string(second_.rejected) + " rejected";
  bool neutral = true;
  for (size_t i = 0; i < strengths_.size(); ++i) {
    if (strengths_[i] == 0) continue;
    neutral = false;
    line +=
        ", " + styling_.model->styles()[i].name + " " + brief(static_cast<double>(strengths_[i]));
  }
  if (neutral) line += ", neutral";
  second_ = {};
  return line;
}

}  // namespace panache::cli
