// How a state lies in 64-bit words; no field crosses a word.
#pragma once

#include <cstdint>
#include <vector>

#include "model.hpp"

namespace core {

struct Field {
  int32_t word, shift;
  int64_t low;
  uint64_t ones;
};

class Layout {
 public:
  explicit Layout(const Model& model) {
    for (const auto& flags : model.locations) {
      locations_.push_back(place(0, static_cast<int64_t>(flags.size()) - 1));
    }
    for (const Range& range : model.variables) {
      variables_.push_back(place(range.low, range.high));
    }
  }

  int words() const { return word_ + 1; }
  const std::vector<Field>& locations() const { return locations_; }
  const std::vector<Field>& variables() const { return variables_; }

 private:
  Field place(int64_t low, int64_t high) {
    int width = 0;
    while (width < 63 && ((high - low) >> width) != 0) ++width;
    if (bit_ + width > 64) {
      ++word_;
      bit_ = 0;
    }
    Field field{word_, bit_ & 63, low, (uint64_t{1} << width) - 1};
    bit_ += width;
    return field;
  }

  std::vector<Field> locations_, variables_;
  int word_ = 0, bit_ = 0;
};

inline std::vector<uint64_t> initial_words(const Model& model, const Layout& layout) {
  std::vector<uint64_t> words(layout.words(), 0);
  size_t i = 0;
  for (const Field& field : layout.locations()) {
    words[field.word] |= static_cast<uint64_t>(model.initial[i++]) << field.shift;
  }
  for (const Field& field : layout.variables()) {
    words[field.word] |= static_cast<uint64_t>(model.initial[i++] - field.low) << field.shift;
  }
  return words;
}

}  // namespace core
