// States by number, without an allocation per state, and from which state each was reached.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "memory.hpp"

namespace core {

constexpr uint32_t kNone = 0xffffffff;

// A sequence that grows in pieces, so that growing copies nothing.
template <class T>
class Pieces {
 public:
  // The list of pieces never moves: some threads look at states while one appends others.
  explicit Pieces(size_t width = 1) : width_(width) { pieces_.reserve(kMostPieces); }

  T* operator[](uint64_t i) { return pieces_[i >> kShift].data() + (i & kMask) * width_; }
  const T* operator[](uint64_t i) const {
    return pieces_[i >> kShift].data() + (i & kMask) * width_;
  }

  T* append() {
    if ((size_ & kMask) == 0) {
      pieces_.emplace_back((size_t{1} << kShift) * width_);
    }
    return (*this)[size_++];
  }

  uint64_t size() const { return size_; }

 private:
  static constexpr int kShift = 18;
  static constexpr uint64_t kMask = (uint64_t{1} << kShift) - 1;
  static constexpr size_t kMostPieces = size_t{1} << (32 - kShift);
  size_t width_;
  uint64_t size_ = 0;
  std::vector<Block<T>> pieces_;
};

inline uint64_t mix(uint64_t x) {
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93u;
  return x ^ x >> 32;
}

inline uint64_t hash_of(const uint64_t* words, int count) {
  uint64_t h = 0x9e3779b97f4a7c15u;
  for (int i = 0; i < count; ++i) h = mix(h ^ words[i]);
  return h;
}

// Which state each state was first reached from. States are numbered in the order in which they
// are found, and expanded in that order; so parents never decrease and one bit for each state
// and one for each parent suffice: 0 is a child, 1 ends the children of a parent.
class Parents {
 public:
  void child(uint32_t parent) {
    for (; ended_ < parent; ++ended_) push(true);
    if (children_ % kStride == 0) samples_.push_back({bits_, ended_});
    push(false);
    ++children_;
  }

  uint32_t of(uint32_t state) const {
    // State 0 is nobody's child, so child k is state k + 1.
    const uint32_t child = state - 1;
    const Sample& sample = samples_[child / kStride];
    uint64_t bit = sample.bit;
    uint32_t parent = sample.parent, seen = child / kStride * kStride;
    while (true) {
      if (*words_[bit >> 6] >> (bit & 63) & 1) {
        ++parent;
      } else if (seen++ == child) {
        return parent;
      }
      ++bit;
    }
  }

  std::vector<uint32_t> path_to(uint32_t state) const {
    std::vector<uint32_t> path{state};
    while (state != 0) path.push_back(state = of(state));
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  struct Sample {
    uint64_t bit;
    uint32_t parent;
  };
  static constexpr uint32_t kStride = 4096;

  void push(bool one) {
    if ((bits_ & 63) == 0) *words_.append() = 0;
    if (one) *words_[bits_ >> 6] |= uint64_t{1} << (bits_ & 63);
    ++bits_;
  }

  Pieces<uint64_t> words_;
  std::vector<Sample> samples_;
  uint64_t bits_ = 0;
  uint32_t children_ = 0, ended_ = 0;
};

// An open-addressing table of state numbers; the bits a number leaves free hold part of the
// hash, which spares most looks at the states themselves.
class States {
 public:
  explicit States(int words) : words_(words), states_(words) { resize(12); }

  uint64_t size() const { return states_.size(); }
  const uint64_t* operator[](uint32_t number) const { return states_[number]; }

  void prefetch(uint64_t hash) const { __builtin_prefetch(&table_[hash & mask_]); }

  // Bytes by which the table grows before it takes `more` states.
  uint64_t growth(uint64_t more) const {
    const bool grows = (states_.size() + more) * 4 >= (mask_ + 1) * 3;
    return grows ? (uint64_t{1} << log_) * sizeof(uint32_t) : 0;
  }

  // The number of a state, and whether it is new.
  std::pair<uint32_t, bool> insert(const uint64_t* state, uint64_t hash) {
    uint64_t at = hash & mask_;
    const uint32_t tag = tag_of(hash);
    while (const uint32_t entry = table_[at]) {
      if ((entry & ~number_mask_) == tag) {
        const uint32_t number = (entry & number_mask_) - 1;
        if (equal(states_[number], state)) return {number, false};
      }
      at = (at + 1) & mask_;
    }
    const uint32_t number = static_cast<uint32_t>(states_.size());
    std::memcpy(states_.append(), state, words_ * sizeof(uint64_t));
    table_[at] = tag | (number + 1);
    if (is_full()) grow();
    return {number, true};
  }

  // The number of a state, kNone if it was never inserted.
  uint32_t find(const uint64_t* state) const {
    const uint64_t hash = hash_of(state, words_);
    uint64_t at = hash & mask_;
    const uint32_t tag = tag_of(hash);
    while (const uint32_t entry = table_[at]) {
      if ((entry & ~number_mask_) == tag) {
        const uint32_t number = (entry & number_mask_) - 1;
        if (equal(states_[number], state)) return number;
      }
      at = (at + 1) & mask_;
    }
    return kNone;
  }

  bool is_full() const { return states_.size() * 4 >= (mask_ + 1) * 3; }
  static constexpr int kMaxLog = 32;

 private:
  bool equal(const uint64_t* a, const uint64_t* b) const {
    for (int i = 0; i < words_; ++i) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }

  uint32_t tag_of(uint64_t hash) const {
    return static_cast<uint32_t>(hash >> 32) & ~number_mask_;
  }

  void resize(int log) {
    log_ = log;
    mask_ = (uint64_t{1} << log) - 1;
    // Numbers stay below the size of the table, so they need no more bits than its index.
    number_mask_ = log >= 32 ? 0xffffffffu : static_cast<uint32_t>(mask_);
    table_ = Block<uint32_t>(mask_ + 1);
  }

  void grow() {
    if (log_ == kMaxLog) throw std::length_error("more than 3 * 2^30 states");
    table_ = Block<uint32_t>();
    resize(log_ + 1);
    // Hashes are worked out some states ahead, so that their places arrive in time.
    constexpr uint64_t kAhead = 16;
    uint64_t hashes[kAhead];
    const uint64_t count = states_.size();
    for (uint64_t i = 0; i < count + kAhead; ++i) {
      if (i >= kAhead) {
        const uint64_t hash = hashes[i % kAhead];
        uint64_t at = hash & mask_;
        while (table_[at]) at = (at + 1) & mask_;
        table_[at] = tag_of(hash) | static_cast<uint32_t>(i - kAhead + 1);
      }
      if (i < count) {
        hashes[i % kAhead] = hash_of(states_[i], words_);
        prefetch(hashes[i % kAhead]);
      }
    }
  }

  int words_, log_ = 0;
  uint64_t mask_ = 0;
  uint32_t number_mask_ = 0;
  Pieces<uint64_t> states_;
  Block<uint32_t> table_;
};

}  // namespace core
