#include "npz.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <zip.h>

#include "clip/smpl.h"

namespace panache::cli {
namespace {

// Max unpacked bytes of all members in an archive of `packed` bytes. Motion compresses to a half or
// a third, a motionless skeleton to less.
size_t max_unpacked(size_t packed) {
  return std::min(size_t{1} << 30, std::max(size_t{32} << 20, 20 * packed));
}
constexpr zip_int64_t kMaxMembers = 1000;

// The bytes of a member, or slightly more than `max` of them; the size in its header is not
// trusted.
Result<std::string> unpack(zip_t* zip, zip_uint64_t which, size_t max, const std::string& where) {
  zip_file_t* file = zip_fopen_index(zip, which, 0);
  if (!file) return Error{where + ": cannot be unpacked: " + zip_strerror(zip)};
  std::string out;
  std::vector<char> block(1 << 16);
  zip_int64_t got = 0;
  while ((got = zip_fread(file, block.data(), block.size())) > 0 && out.size() <= max) {
    out.append(block.data(), static_cast<size_t>(got));
  }
  const std::string message = got < 0 ? zip_file_strerror(file) : "";
  zip_fclose(file);
  if (!message.empty()) return Error{where + ": cannot be unpacked: " + message};
  return out;
}

Result<std::vector<NpzMember>> unpack_all(const std::string& bytes, const std::string& path) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  const std::unique_ptr<zip_t, decltype(&zip_discard)> archive(
      source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr, &zip_discard);
  const std::string message = archive ? "" : zip_error_strerror(&error);
  zip_error_fini(&error);
  if (!archive) {
    zip_source_free(source);
    return Error{path + ": expected an archive as numpy.savez writes it, found none (" + message +
                 ")"};
  }
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  if (count > kMaxMembers) {
    return Error{path + ": expected at most " + std::to_string(kMaxMembers) + " arrays, found " +
                 std::to_string(count)};
  }
  std::vector<NpzMember> members;
  const size_t max = max_unpacked(bytes.size());
  size_t left = max;
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto which = static_cast<zip_uint64_t>(i);
    const char* name = zip_get_name(archive.get(), which, ZIP_FL_ENC_RAW);
    const std::string known = name ? name : "";
    Result<std::string> unpacked =
        unpack(archive.get(), which, left, path + ": " + known.substr(0, 40));
    if (!unpacked) return unpacked.error();
    if (unpacked->size() > left) {
      return Error{path + ": expected at most " + std::to_string(max >> 20) +
                   " MB unpacked in a file of " + std::to_string(bytes.size()) +
                   " bytes, found more; save it with numpy.savez, without compression"};
    }
    left -= unpacked->size();
    members.push_back({known, *std::move(unpacked)});
  }
  return members;
}

// Writing to memory fails only if memory runs out.
std::string pack(const std::vector<NpzMember>& members) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_source_keep(target);
  zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, &error);
  assert(zip);
  for (const NpzMember& member : members) {
    zip_source_t* source = zip_source_buffer(zip, member.bytes.data(), member.bytes.size(), 0);
    const zip_int64_t at = zip_file_add(zip, member.name.c_str(), source, ZIP_FL_OVERWRITE);
    assert(at >= 0);
    const auto which = static_cast<zip_uint64_t>(at);
    zip_set_file_compression(zip, which, ZIP_CM_STORE, 0);
    zip_file_set_dostime(zip, which, 0, 1 << 5 | 1, 0);  // 1980-01-01, as numpy writes it.
  }
  [[maybe_unused]] const int closed = zip_close(zip);
  assert(closed == 0);
  zip_source_open(target);
  zip_source_seek(target, 0, SEEK_END);
  std::string out(static_cast<size_t>(zip_source_tell(target)), '\0');
  zip_source_seek(target, 0, SEEK_SET);
  zip_source_read(target, out.data(), out.size());
  zip_source_close(target);
  zip_source_free(target);
  zip_error_fini(&error);
  return out;
}

std::string write_npz(const Clip& clip, const std::string&, const Placement&, const SkinnedBody*) {
  return pack(format_smpl(clip));
}

}  // namespace

Result<std::unique_ptr<MotionFile>> parse_npz(std::string bytes, const std::string& path,
                                              const ReadOptions& options) {
  Result<std::vector<NpzMember>> members = unpack_all(bytes, path);
  if (!members) return members.error();
  return parse_smpl(*std::move(members), std::move(bytes), pack, path, options);
}

std::string (*const kWriteNpz)(const Clip&, const std::string&, const Placement&,
                               const SkinnedBody*) = write_npz;

}  // namespace panache::cli
