#include "clip/gltf_json.h"

#include <cmath>

#include "clip/text_cursor.h"

namespace panache {
namespace {

// Integers up to this are exact as doubles, which some writers use.
constexpr double kLargestCount = 9007199254740992.0;

// Whether `text` nests deeper, or has larger objects, than we accept. Strings are skipped; whether
// the text is valid JSON is left to the parser.
bool is_excessive(std::string_view text) {
  std::vector<int> members;  // Colons per open bracket.
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (members.size() == kGltfMaxJsonDepth) return true;
      members.push_back(0);
    } else if ((c == '}' || c == ']') && !members.empty()) {
      members.pop_back();
    } else if (c == ':' && !members.empty() && ++members.back() > kGltfMaxJsonMembers) {
      return true;
    }
  }
  return false;
}

bool to_count(const GltfJson& value, uint64_t& out) {
  if (value.is_number_unsigned()) {
    out = value.get<uint64_t>();
    return true;
  }
  if (!value.is_number_float()) return false;
  const double number = value.get<double>();
  if (!(number >= 0 && number <= kLargestCount) || number != std::floor(number)) return false;
  out = static_cast<uint64_t>(number);
  return true;
}

// A short form of a value, for messages.
std::string shown(const GltfJson& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  const std::string text = value.dump();
  return text.size() <= 40 ? text : value.is_string() ? "a long text" : "a long number";
}

}  // namespace

std::string member_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string item_path(const std::string& path, size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

bool GltfChecker::fail(const std::string& path, const std::string& message) {
  if (ok()) message_ = name_ + ": " + (path.empty() ? "" : path + ": ") + message;
  return false;
}

bool GltfChecker::parse(std::string_view text, GltfJson& out) {
  if (is_excessive(text)) {
    return fail("", "expected JSON at most " + std::to_string(kGltfMaxJsonDepth) +
                        " brackets deep and with at most " + std::to_string(kGltfMaxJsonMembers) +
                        " members in an object, found more");
  }
  out = GltfJson::parse(text.begin(), text.end(), nullptr, false);
  if (out.is_discarded()) {
    return fail("", "expected glTF, found text that is not JSON; is the file complete?");
  }
  return out.is_object() || fail("", "expected glTF, a JSON object, found " + shown(out));
}

GltfPart GltfPart::wrong(const std::string& expected) const {
  fail("expected " + expected + ", found " + shown(*json_));
  return {nullptr, *checker_, path_};
}

GltfPart GltfPart::member(const std::string& key) const {
  if (json_ && !json_->is_object()) return wrong("an object");
  const GltfJson* found = nullptr;
  if (json_) {
    const auto at = json_->find(key);
    if (at != json_->end()) found = &*at;
  }
  return {found, *checker_, member_path(path_, key)};
}

GltfPart GltfPart::member(const std::string& key, bool (GltfJson::*is)() const noexcept,
                          const std::string& kind) const {
  const GltfPart value = member(key);
  return value && !(value.json().*is)() ? value.wrong(kind) : value;
}

GltfPart GltfPart::object(const std::string& key) const {
  return member(key, &GltfJson::is_object, "an object");
}

std::vector<std::pair<std::string, GltfPart>> GltfPart::members() const {
  constexpr size_t kLongest = 40;
  std::vector<std::pair<std::string, GltfPart>> out;
  if (!json_) return out;
  for (const auto& [key, value] : json_->items()) {
    const std::string path = member_path(path_, key.substr(0, kLongest));
    out.emplace_back(key, GltfPart(&value, *checker_, path));
  }
  return out;
}

std::vector<GltfPart> GltfPart::list(const std::string& key) const {
  std::vector<GltfPart> out;
  const size_t count = size(key);
  out.reserve(count);
  for (size_t i = 0; i < count; ++i) out.push_back(item(key, i));
  return out;
}

size_t GltfPart::size(const std::string& key) const {
  const GltfPart value = member(key, &GltfJson::is_array, "a list");
  return value ? value.json().size() : 0;
}

GltfPart GltfPart::item(const std::string& key, size_t index) const {
  return {&(*json_)[key][index], *checker_, item_path(member_path(path_, key), index)};
}

std::string GltfPart::text(const std::string& key, const std::string& otherwise) const {
  const GltfPart value = member(key, &GltfJson::is_string, "a text");
  return value ? value.json().get<std::string>() : otherwise;
}

bool GltfPart::flag(const std::string& key) const {
  const GltfPart value = member(key, &GltfJson::is_boolean, "true or false");
  return value && value.json().get<bool>();
}

uint64_t GltfPart::count(const std::string& key, uint64_t otherwise) const {
  const GltfPart value = member(key);
  if (value && !to_count(value.json(), otherwise)) value.wrong("a whole number");
  return otherwise;
}

int GltfPart::index(const std::string& key, size_t size) const {
  const GltfPart value = member(key);
  return value ? value.as_index(size) : -1;
}

int GltfPart::as_index(size_t size) const {
  uint64_t value = 0;
  if (to_count(*json_, value) && value < size) return static_cast<int>(value);
  wrong("a whole number below " + std::to_string(size));
  return -1;
}

void GltfPart::numbers(const std::string& key, std::span<double> out) const {
  const size_t count = out.size();
  const GltfPart value = member(key);
  if (!value) return;
  if (!value.json().is_array() || value.json().size() != count) {
    value.wrong(std::to_string(count) + " numbers");
    return;
  }
  for (size_t i = 0; i < count; ++i) {
    const GltfPart number = item(key, i);
    out[i] = number.json().is_number() ? number.json().get<double>() : 2 * kLargestNumber;
    if (!(std::abs(out[i]) <= kLargestNumber)) number.wrong("a number between -1e9 and 1e9");
  }
}

}  // namespace panache
