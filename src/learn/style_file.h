#pragma once
// Styles as files: extracted from a model, added to another, renamed, removed.

#include <map>
#include <span>
#include <string>

#include "base/result.h"
#include "learn/take.h"
#include "net/safetensors.h"
#include "style/model/model.h"

namespace panache {

// The identity of a model's trunk, as 16 hexadecimal digits: a hash of its normalisation and of the
// pose trunk's biases, which a model shares with its int8 version. A style fits every model with
// the same fingerprint.
std::string trunk_fingerprint(const TensorFile& model);

// Checks that people can type this name and that files can hold it: 1 to 60 bytes of UTF-8 without
// control characters, '=' and ',', without a space at either end or a '-' at the start. "seconds"
// is reserved for tables of strengths.
Result<void> check_style_name(const std::string& name);

// Whether this is valid UTF-8 without control characters, as required for entries in a model's
// lists of styles.
bool is_one_line(const std::string& text);

// Whether the file says that it is a style, not a model.
bool is_style_file(const TensorFile& file);
// The metadata of a style file. Rejects files that extract_style() does not write: other versions,
// texts of more than one line, unknown tensors, non-finite numbers. The shapes of the tensors
// depend on the model and are checked by add_style(). Error messages start with `name`.
Result<StyleInfo> read_style_info(const TensorFile& file, const std::string& name);

// Makes the file of a style from a model, or learnt on one. `tensors` have their names in a style
// file; description and origin are converted to one line of UTF-8.
TensorFile make_style_file(const TensorFile& model, const StyleInfo& info,
                           std::map<std::string, Tensor> tensors);

// Sets the source of a style file's motion and the licence of the style, if they are given.
void set_source(const std::string& source, const std::string& licence, TensorFile& style);

// The name of a gesture among the tensors of a style file; the first is 0.
std::string gesture_key(size_t gesture);

// The following functions return a new file and do not change their arguments. Model files are
// rejected if Model::create() rejects them, error messages start with `name`, and all other styles
// stay the same bit for bit.

// The style file for the model's style called `style`. Fails for models without style heads.
Result<TensorFile> extract_style(const TensorFile& model, const std::string& style,
                                 const std::string& name);
// The model with the style of a style file; a style of the same name is replaced (`replace`), or
// the file is rejected. Built-in styles go after the built-in ones, learnt ones to the end.
// Model::create() checks the style's shapes and numbers.
Result<TensorFile> add_style(const TensorFile& model, const std::string& name,
                             const TensorFile& style, const std::string& style_name, bool replace);
// The model whose style called `style` has exactly these gestures, at most kMaxGestures, `rate` of
// them a second.
Result<TensorFile> set_gestures(const TensorFile& model, const std::string& style,
                                std::span<const Gesture> gestures, float rate,
                                const std::string& name);
// The model without a style. It keeps at least one.
Result<TensorFile> remove_style(const TensorFile& model, const std::string& style,
                                const std::string& name);
// The model with the style `from` renamed to `to`. For any recipe.
Result<TensorFile> rename_style(const TensorFile& model, const std::string& from,
                                const std::string& to, const std::string& name);

// thumbnail.cpp: a picture of a style, small enough to store in its file.
// A row of stick figures as an SVG file in one line, of less than 6 KB for six figures. `bodies`:
// in the body frame, metres. The body's right is drawn dark, its left light.
std::string draw_thumbnail(std::span<const HumanPositions> bodies);

// Six instants of the middle 1.5 seconds of a take, or the single one of a pose.
std::string thumbnail_of(const Take& take);

}  // namespace panache
