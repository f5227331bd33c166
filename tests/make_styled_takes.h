#pragma once
// Takes of the made-up styles, as they are after reading.

#include <string>
#include <vector>

#include "learn/take.h"
#include "make_styles.h"

namespace panache::test {

inline Take styled_take(const std::string& style, const std::string& content, int take,
                        int frames = 90) {
  const Clip clip = styled_clip(style, content, take, frames);
  Take made = make_take(clip, *Rig::create(clip), PoseLayout::positions);
  const std::string number = std::to_string(take);
  made.row = {style + content + number, style, content, number, style == "neutral", false, 0};
  return made;
}

// Every style and content, these numbers of takes of each.
inline std::vector<Take> styled_takes(const std::vector<std::string>& styles,
                                      const std::vector<int>& numbers, int frames = 90) {
  std::vector<Take> takes;
  for (const std::string& style : styles) {
    for (const char* content : kContents) {
      for (const int n : numbers) takes.push_back(styled_take(style, content, n, frames));
    }
  }
  return takes;
}

}  // namespace panache::test
