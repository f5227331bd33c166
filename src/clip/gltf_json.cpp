#include "clip/gltf_json.h"

#include <cmath>

#include "clip/decimal.h"

namespace panache {
namespace {

// Whole numbers up to here are exact as doubles, which is how some writers put them.
constexpr double kLargestCount = 9007199254740992.0;

// Whether `text` nests deeper or has larger objects than we read. Strings are passed over; whether
// the text is JSON at all is the parser's to say.
bool is_excessive(std::string_view text) {
  std::vector<int> members;  // Per open bracket, the colons in it.
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (members.size() == static_cast<size_t>(kGltfMaxJsonDepth)) return true;
      members.push_back(0);
    } else if ((c == '}' || c == ']') && !members.empty()) {
      members.pop_back();
    } else if (c == ':' && !members.empty() && ++members.back() > kGltfMaxJsonMembers) {
      return true;
    }
  }
  return false;
}

const GltfJson* find(const GltfJson& object, const char* key) {
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
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

// A value for a message, short.
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
  if (!failed()) message_ = name_ + ": " + (path.empty() ? "" : path + ": ") + message;
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

bool GltfChecker::is_object(const GltfJson& value, const std::string& path) {
  return value.is_object() || fail(path, "expected an object, found " + shown(value));
}

bool GltfChecker::list(const GltfJson& object, const std::string& path, const char* key,
                       const GltfJson*& out) {
  static const GltfJson none = GltfJson::array();
  const GltfJson* value = find(object, key);
  out = value ? value : &none;
  return out->is_array() || fail(member_path(path, key), "expected a list, found " + shown(*out));
}

bool GltfChecker::object(const GltfJson& object, const std::string& path, const char* key,
                         const GltfJson*& out) {
  out = find(object, key);
  return !out || is_object(*out, member_path(path, key));
}

bool GltfChecker::text(const GltfJson& object, const std::string& path, const char* key,
                       std::string& out) {
  const GltfJson* value = find(object, key);
  if (!value) return true;
  if (!value->is_string()) {
    return fail(member_path(path, key), "expected a text, found " + shown(*value));
  }
  out = value->get_ref<const std::string&>();
  return true;
}

bool GltfChecker::flag(const GltfJson& object, const std::string& path, const char* key,
                       bool& out) {
  const GltfJson* value = find(object, key);
  if (!value) return true;
  if (!value->is_boolean()) {
    return fail(member_path(path, key), "expected true or false, found " + shown(*value));
  }
  out = value->get<bool>();
  return true;
}

bool GltfChecker::count(const GltfJson& object, const std::string& path, const char* key,
                        uint64_t& out) {
  const GltfJson* value = find(object, key);
  if (!value || to_count(*value, out)) return true;
  return fail(member_path(path, key), "expected a whole number, found " + shown(*value));
}

bool GltfChecker::index_value(const GltfJson& value, const std::string& path, size_t size,
                              int& out) {
  uint64_t place = 0;
  if (!to_count(value, place) || place >= size) {
    return fail(
        path, "expected a whole number below " + std::to_string(size) + ", found " + shown(value));
  }
  out = static_cast<int>(place);
  return true;
}

bool GltfChecker::index(const GltfJson& object, const std::string& path, const char* key,
                        size_t size, int& out) {
  out = -1;
  const GltfJson* value = find(object, key);
  return !value || index_value(*value, member_path(path, key), size, out);
}

bool GltfChecker::numbers(const GltfJson& object, const std::string& path, const char* key,
                          std::span<double> out) {
  const GltfJson* value = find(object, key);
  if (!value) return true;
  if (!value->is_array() || value->size() != out.size()) {
    return fail(member_path(path, key),
                "expected " + std::to_string(out.size()) + " numbers, found " + shown(*value));
  }
  for (size_t i = 0; i < out.size(); ++i) {
    const GltfJson& item = (*value)[i];
    const double number = item.is_number() ? item.get<double>() : 2 * kLargestNumber;
    if (!(std::abs(number) <= kLargestNumber)) {
      return fail(item_path(member_path(path, key), i),
                  "expected a number between -1e9 and 1e9, found " + shown(item));
    }
    out[i] = number;
  }
  return true;
}

}  // namespace panache
