#pragma once
// Styles as files of their own: taken out of a model, put into another, renamed, removed.

#include <map>
#include <span>
#include <string>

#include "base/result.h"
#include "net/safetensors.h"
#include "style/model.h"

namespace panache {

// The identity of a model's trunk, as 16 hexadecimal digits: a hash of its normalisation and of
// the pose trunk's biases, which a model shares with its int8 twin. A style goes with every
// model of its own model's fingerprint.
std::string trunk_fingerprint(const TensorFile& model);

// Whether people can type this name and files can hold it: 1 to 60 bytes of UTF-8 without control
// characters, '=' and ',', without a space at either end or a '-' at the start. "seconds" is taken
// by tables of strengths.
Result<void> check_style_name(const std::string& name);

// Whether this is valid UTF-8 without control characters, as each entry in a model's lists of
// styles must be.
bool is_one_line(const std::string& text);

// Whether the file says that it is a style, and not a model.
bool is_style_file(const TensorFile& file);
// The metadata of a style file. Files are rejected that extract_style() does not write:
// other versions, texts that are no single line, tensors that no style has, numbers that are not
// finite. What shapes the tensors must have, only a model can tell, see add_style(). `name` stands
// in front of the message of a failure.
Result<StyleInfo> read_style_info(const TensorFile& file, const std::string& name);

// The style file of a style of a model, or learnt on one. `tensors` are called as in a style file;
// description and origin become one line of UTF-8.
TensorFile make_style_file(const TensorFile& model, const StyleInfo& info,
                           std::map<std::string, Tensor> tensors);

// States where the motion of a style file comes from and under which licence the style is, where
// they are given.
void set_source(const std::string& source, const std::string& licence, TensorFile& style);

// What a gesture is called among the tensors of a style file, the first with 0.
std::string gesture_key(size_t gesture);

// Each of these hands back a new file and leaves what it is given alone. Model files are rejected
// where Model::create() rejects them, `name` stands in front of messages, and all styles but the
// one in question stay bit for bit what they are.

// The style file of the model's style called `style`. Models without style heads have none to give.
Result<TensorFile> extract_style(const TensorFile& model, const std::string& style,
                                 const std::string& name);
// The model with the style of a style file; where it has one of this name, that is replaced
// (`replace`) or the file rejected. Built-in styles go behind the built-in ones, learnt ones to the
// end. The style's shapes and numbers are judged by Model::create().
Result<TensorFile> add_style(const TensorFile& model, const std::string& name,
                             const TensorFile& style, const std::string& style_name, bool replace);
// The model whose style called `style` has these gestures, at most kMaxGestures, and no others.
Result<TensorFile> set_gestures(const TensorFile& model, const std::string& style,
                                std::span<const Gesture> gestures, const std::string& name);
// The model without a style. It keeps at least one.
Result<TensorFile> remove_style(const TensorFile& model, const std::string& style,
                                const std::string& name);
// The model with a style called `to` instead of `from`. Of any recipe.
Result<TensorFile> rename_style(const TensorFile& model, const std::string& from,
                                const std::string& to, const std::string& name);

}  // namespace panache
