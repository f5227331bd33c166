#include "vmc_messages.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <string_view>

#include <lo/lo.h>

#include "messages.h"
#include "vmc_bones.h"

namespace panache::cli {
namespace {

constexpr const char* kBonePath = "/VMC/Ext/Bone/Pos";
constexpr const char* kRootPath = "/VMC/Ext/Root/Pos";
constexpr const char* kOkPath = "/VMC/Ext/OK";
constexpr const char* kTimePath = "/VMC/Ext/T";
constexpr std::string_view kBundle("#bundle\0", 8);
constexpr size_t kBundleHead = 16;  // "#bundle" and a time tag.
constexpr int kMaxNesting = 8;      // Levels of nested bundles.

uint32_t read_number(std::span<const char> bytes, size_t at) {
  uint32_t out = 0;
  for (size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(bytes[at + i]);
  return out;
}

void put_floats(std::span<char> bytes, size_t at, std::initializer_list<float> values) {
  assert(at + 4 * values.size() <= bytes.size());
  for (const float value : values) {
    const auto number = std::bit_cast<uint32_t>(value);
    for (int shift = 24; shift >= 0; shift -= 8) bytes[at++] = static_cast<char>(number >> shift);
  }
}

// OSC pads strings with one to four zeros.
size_t padded(size_t length) { return length / 4 * 4 + 4; }

// An argument of a message, a string; the first by default. An lo_arg is only aligned as the
// message is, so it must not be accessed as a union.
std::string_view string_at(lo_arg** arguments, size_t index = 0) {
  return reinterpret_cast<const char*>(arguments[index]);
}

// Reads the message's name and values if it is a bone message.
void read_bone(VmcMessage& out, std::span<const char> bytes, std::string_view path,
               std::string_view types, std::string_view name) {
  const std::optional<int> bone = path == kRootPath ? kVmcRoot : find_vmc_bone(name);
  if (!bone) return;
  out.kind = VmcMessage::bone;
  out.bone_index = *bone;
  out.offset = padded(path.size()) + padded(types.size() + 1) + padded(name.size());
  float n[7];
  for (size_t i = 0; i < 7; ++i)
    n[i] = std::bit_cast<float>(read_number(bytes, out.offset + 4 * i));
  out.position = mirrored_position({n[0], n[1], n[2]});
  out.rotation = mirrored_rotation({n[3], n[4], n[5], n[6]});
}

// `begin`: the message's offset in the datagram.
VmcMessage read_message(std::span<const char> bytes, size_t begin) {
  VmcMessage out;
  const std::unique_ptr<void, decltype(&lo_message_free)> message(
      lo_message_deserialise(const_cast<char*>(bytes.data()), bytes.size(), nullptr),
      &lo_message_free);
  if (!message) return out;
  const std::string_view path = bytes.data();  // Zero-terminated, as liblo has checked.
  const std::string_view types = lo_message_get_types(message.get());
  lo_arg** arguments = lo_message_get_argv(message.get());
  if (path == kBonePath || path == kRootPath) {
    // The root's values may be followed by scale and offset.
    if (types.starts_with("sfffffff")) read_bone(out, bytes, path, types, string_at(arguments));
    out.offset += begin;
  } else if (path == kOkPath || path == kTimePath) {
    out.kind = VmcMessage::frame_end;
  } else if (path == "/panache/reset") {
    out.kind = VmcMessage::reset;
  } else if (path == "/panache/side" && types == "ss") {
    out.kind = VmcMessage::side;
    out.name = string_at(arguments);
    out.side_text = string_at(arguments, 1);
  } else if (path == "/panache/side" && (types == "sf" || types == "si" || types == "sd")) {
    out.kind = VmcMessage::side;
    out.name = string_at(arguments);
    out.side_text =
        brief(static_cast<double>(lo_hires_val(static_cast<lo_type>(types[1]), arguments[1])));
  } else if (path == "/panache/style" && (types == "sf" || types == "si" || types == "sd")) {
    out.kind = VmcMessage::style;
    out.name = string_at(arguments);
    out.strength = static_cast<double>(lo_hires_val(static_cast<lo_type>(types[1]), arguments[1]));
  }
  return out;
}

// Reads the message or bundle datagram[begin, end) into `out`.
bool read_element(std::span<const char> datagram, size_t begin, size_t end, int depth,
                  std::vector<VmcMessage>& out) {
  const std::span<const char> bytes = datagram.subspan(begin, end - begin);
  if (bytes.size() < 4 || bytes.size() % 4 != 0 || depth > kMaxNesting) return false;
  if (!std::string_view(bytes.data(), bytes.size()).starts_with(kBundle)) {
    if (bytes[0] != '/' || std::find(bytes.begin(), bytes.end(), '\0') == bytes.end()) return false;
    out.push_back(read_message(bytes, begin));
    return true;
  }
  if (bytes.size() < kBundleHead) return false;
  size_t at = begin + kBundleHead;
  while (at < end) {
    // Both are multiples of four bytes, so at least four are left for the size.
    const size_t size = read_number(datagram, at);
    at += 4;
    if (size > end - at || !read_element(datagram, at, at + size, depth + 1, out)) return false;
    at += size;
  }
  return true;
}

void add_bone(lo_bundle bundle, const VmcFrame::Bone& bone) {
  const Vec3 p = mirrored_position(bone.position);
  const Quat q = mirrored_rotation(bone.rotation);
  const lo_message message = lo_message_new();
  lo_message_add_string(message, std::string(vmc_bone_name(bone.index)).c_str());
  for (const float value : {p.x, p.y, p.z, q.x, q.y, q.z, q.w}) {
    lo_message_add_float(message, value);
  }
  lo_bundle_add_message(bundle, bone.index == kVmcRoot ? kRootPath : kBonePath, message);
}

void add_end(lo_bundle bundle, double seconds) {
  const lo_message ok = lo_message_new(), time = lo_message_new();
  lo_message_add_int32(ok, 1);
  lo_message_add_float(time, static_cast<float>(seconds));
  lo_bundle_add_message(bundle, kOkPath, ok);
  lo_bundle_add_message(bundle, kTimePath, time);
}

std::vector<char> bytes_of(lo_bundle bundle) {
  size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(
      lo_bundle_serialise(bundle, nullptr, &size), &std::free);
  lo_bundle_free_recursive(bundle);
  const char* begin = static_cast<const char*>(bytes.get());
  return std::vector<char>(begin, begin + size);
}

}  // namespace

std::optional<std::vector<VmcMessage>> read_vmc(std::span<const char> datagram) {
  std::vector<VmcMessage> out;
  if (!read_element(datagram, 0, datagram.size(), 0, out)) return std::nullopt;
  return out;
}

void put_position(std::span<char> datagram, size_t offset, Vec3 position) {
  const Vec3 p = mirrored_position(position);
  put_floats(datagram, offset, {p.x, p.y, p.z});
}

void put_rotation(std::span<char> datagram, size_t offset, Quat rotation) {
  const Quat q = mirrored_rotation(rotation);
  put_floats(datagram, offset + 12, {q.x, q.y, q.z, q.w});
}

std::vector<std::vector<char>> format_vmc(const VmcFrame& frame) {
  // The message with the longest name takes 88 bytes, so the bundle stays below 1,500.
  constexpr size_t kBonesPerBundle = 12;
  std::vector<std::vector<char>> out;
  for (size_t i = 0; i < frame.bones.size(); i += kBonesPerBundle) {
    const lo_bundle bundle = lo_bundle_new(LO_TT_IMMEDIATE);
    const size_t end = std::min(i + kBonesPerBundle, frame.bones.size());
    for (size_t b = i; b < end; ++b) add_bone(bundle, frame.bones[b]);
    if (end == frame.bones.size()) add_end(bundle, frame.seconds);
    out.push_back(bytes_of(bundle));
  }
  return out;
}

}  // namespace panache::cli
