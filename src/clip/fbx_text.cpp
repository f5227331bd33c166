// The nodes of an FBX text file.

#include <algorithm>
#include <cstring>

#include "clip/fbx_tree.h"
#include "clip/text_cursor.h"

namespace panache {
namespace {

class FbxTextParser {
 public:
  FbxTextParser(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<void> read(FbxNode& root) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
    root.begin = at_;
    if (const size_t zero = text_.find('\0'); zero != text_.npos) {
      return Error{fbx_position(text_, zero, name_) +
                   ": expected text, found a byte of 0; is the file damaged?"};
    }
    if (auto good = read_children(root, 0); !good) return good;
    if (!is_end()) return error("the end of the file");  // An unmatched closing brace.
    root.end = at_;
    return {};
  }

 private:
  bool is_end() const { return at_ == text_.size(); }
  char here() const { return is_end() ? '\0' : text_[at_]; }

  void skip_space() {
    while (!is_end()) {
      if (here() == ';') {  // A comment.
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (here() != '\0' && std::strchr(" \t\r\n\v\f", here())) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view word() const {
    return text_.substr(at_, text_.find_first_of(kFbxNoWord, at_) - at_);
  }

  // Whether the text continues with `Name:`.
  bool is_at_name() const {
    const size_t after = text_.find_first_not_of(" \t", at_ + word().size());
    return !word().empty() && after < text_.size() && text_[after] == ':';
  }

  Error error(const std::string& expected) const {
    const std::string_view here_is = word().empty() ? text_.substr(at_, 1) : word();
    return {fbx_position(text_, at_, name_) + ": expected " + expected + ", found " +
            (is_end() ? "the end of the file" : panache::quoted(here_is))};
  }

  Result<void> read_children(FbxNode& parent, int depth) {
    if (depth > kFbxMaxDepth) {
      return error("at most " + std::to_string(kFbxMaxDepth) + " open braces");
    }
    parent.has_list = true;
    for (skip_space(); !is_end() && here() != '}'; skip_space()) {
      if (!is_at_name()) return error("a name with a colon behind it");
      if (++nodes_ > kFbxMaxNodes) {
        return error("at most " + std::to_string(kFbxMaxNodes) + " names");
      }
      FbxNode& node = parent.children.emplace_back();
      node.begin = at_;
      node.name = word();
      at_ = node.end = text_.find(':', at_) + 1;
      if (auto good = read_values(node); !good) return good;
      if (here() != '{') continue;
      ++at_;
      if (auto good = read_children(node, depth + 1); !good) return good;
      if (here() != '}') return error("'}'");
      node.end = ++at_;
    }
    parent.list_end = at_;
    return {};
  }

  // Values continue on the next line unless it begins with a name.
  Result<void> read_values(FbxNode& node) {
    for (skip_space(); !is_end(); skip_space()) {
      if (here() == ',') {
        node.end = ++at_;  // Also without a value behind it: what replaces the node replaces it.
      } else if (here() == '"') {
        const size_t end = text_.find('"', at_ + 1);
        if (end == std::string_view::npos) return error("a string with another '\"' at its end");
        node.values.push_back({'"', text_.substr(at_ + 1, end - at_ - 1)});
        at_ = node.end = end + 1;
      } else if (!word().empty() && !is_at_name()) {
        node.values.push_back({'w', word()});
        at_ += word().size();
        node.end = at_;
      } else {
        return {};
      }
    }
    return {};
  }

  std::string_view text_;
  const std::string& name_;
  size_t at_ = 0;
  size_t nodes_ = 0;
};

}  // namespace

std::string fbx_position(std::string_view text, size_t offset, const std::string& name) {
  const std::string_view before = text.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t begin = before.rfind('\n') + 1;  // 0 in the first line.
  return name + ":" + std::to_string(line) + ":" + std::to_string(offset - begin + 1);
}

Result<void> parse_fbx_text(std::string_view text, const std::string& name, FbxNode& root) {
  return FbxTextParser(text, name).read(root);
}

}  // namespace panache
