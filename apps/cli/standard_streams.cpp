#include "standard_streams.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace panache::cli {
namespace {

// The extension for the detected format of a file; empty if it is unknown.
std::string extension_of_content(std::string_view bytes) {
  if (bytes.starts_with("glTF")) {
    const bool is_animation = bytes.find("\"VRMC_vrm_animation\"") != std::string_view::npos;
    return is_animation ? ".vrma" : ".glb";
  }
  if (bytes.starts_with("PK\x03\x04")) return ".npz";
  if (bytes.starts_with("Kaydara FBX Binary") || bytes.starts_with("; FBX")) return ".fbx";
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  const std::string_view text =
      bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (text.starts_with("HIERARCHY")) return ".bvh";
  if (text.starts_with("{")) return ".gltf";
  return "";
}

}  // namespace

Result<StdinMotion> read_stdin() {
  std::string bytes;
  char block[1 << 16];
  size_t count;
  while ((count = std::fread(block, 1, sizeof block, stdin)) > 0) bytes.append(block, count);
  if (std::ferror(stdin))
    return Error{std::string("stdin: cannot be read: ") + std::strerror(errno)};
  if (bytes.empty()) return Error{"stdin: is empty; expected a motion file"};
  const std::string extension = extension_of_content(bytes);
  if (extension.empty()) {
    return Error{"stdin: expected a BVH, glTF, GLB, VRM, VRMA or NPZ file, found something else"};
  }
  return StdinMotion{"stdin" + extension, std::move(bytes)};
}

Result<void> write_stdout(std::string_view bytes) {
  if (Result<void> printed = finish_stdout(); !printed) return printed;
  std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  Result<void> written = finish_stdout();
  if (!written) std::clearerr(stdout);
  return written;
}

Result<void> finish_stdout() {
  // If an earlier write failed, another one sets errno to the cause.
  if (std::ferror(stdout)) std::fputc('\n', stdout);
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return {};
  if (errno == 0) errno = EIO;  // The stream works again meanwhile.
  return Error{std::string("stdout: cannot be written: ") + std::strerror(errno)};
}

}  // namespace panache::cli
