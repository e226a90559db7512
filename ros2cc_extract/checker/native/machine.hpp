// One state, unpacked, and the evaluation of nodes over it.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "layout.hpp"
#include "model.hpp"

namespace core {

constexpr int64_t kMaxLoopSteps = 1000000;  // network.py: MAX_LOOP_STEPS

// Hears among which names a pick chose.
class PickJudge {
 public:
  virtual void picked(const Pick& pick, uint64_t names) = 0;

 protected:
  ~PickJudge() = default;
};

class Machine {
 public:
  Machine(const Model& model, const Layout& layout)
      : model_(model),
        layout_(layout),
        at(model.locations.size()),
        value(model.variables.size()),
        packed(layout.words()) {}

  void load(const uint64_t* words) {
    std::memcpy(packed.data(), words, packed.size() * sizeof(uint64_t));
    const auto& locations = layout_.locations();
    for (size_t i = 0; i < at.size(); ++i) {
      const Field& field = locations[i];
      at[i] = static_cast<int32_t>(words[field.word] >> field.shift & field.ones);
    }
    const auto& variables = layout_.variables();
    for (size_t i = 0; i < value.size(); ++i) {
      const Field& field = variables[i];
      value[i] = static_cast<int32_t>(
          static_cast<int64_t>(words[field.word] >> field.shift & field.ones) + field.low);
    }
  }

  void set(int32_t slot, int64_t to) {
    undo_.push_back({slot, value[slot]});
    put(slot, to);
  }

  void move(int32_t process, int32_t to) {
    const Field& field = layout_.locations()[process];
    uint64_t& word = packed[field.word];
    word = (word & ~(field.ones << field.shift)) | static_cast<uint64_t>(to) << field.shift;
    moved_.push_back({process, at[process]});
    at[process] = to;
  }

  // Reset what nobody will read, now that a process has arrived where it is.
  void forget(int32_t process) {
    const int32_t* pair = resets(process);
    if (pair == nullptr) return;
    for (int32_t i = *pair++; i > 0; --i, pair += 2) {
      if (value[pair[0]] != pair[1]) set(pair[0], pair[1]);
    }
  }

  // Whether some process forgets a variable where it is.
  bool is_dead(const Pointer& pointer) const {
    for (const int32_t owner : pointer.owners) {
      const int32_t* pair = resets(owner);
      if (pair == nullptr) continue;
      for (int32_t i = *pair++; i > 0; --i, pair += 2) {
        if (pair[0] == pointer.slot) return true;
      }
    }
    return false;
  }

  // Whether the variable was written since the state was loaded.
  bool is_written(int32_t slot) const {
    for (const Old& old : undo_) {
      if (old.slot == slot) return true;
    }
    return false;
  }

  // Back to the state that was loaded; `words` are its words.
  void restore(const uint64_t* words) {
    for (auto it = undo_.rbegin(); it != undo_.rend(); ++it) value[it->slot] = it->old;
    for (auto it = moved_.rbegin(); it != moved_.rend(); ++it) at[it->slot] = it->old;
    undo_.clear();
    moved_.clear();
    std::memcpy(packed.data(), words, packed.size() * sizeof(uint64_t));
  }

  int64_t evaluate(int32_t index) {
    const Node& node = model_.nodes[index];
    switch (node.op) {
      case Op::CONST: return node.a;
      case Op::VAR: return value[node.a];
      case Op::VAR_IS: return value[node.a] == node.b;
      case Op::ELEMENT: return value[node.a + evaluate(node.b)];
      case Op::TABLE: return model_.lists[node.a + evaluate(node.b)];
      case Op::LOCAL: return frame_[node.a];
      case Op::LOCAL_ELEMENT: {
        const int64_t element = evaluate(node.b);
        return frame_[node.a + element];
      }
      case Op::NEG: return -evaluate(node.a);
      case Op::NOT: return evaluate(node.a) == 0;
      case Op::AND: return evaluate(node.a) != 0 && evaluate(node.b) != 0;
      case Op::OR: return evaluate(node.a) != 0 || evaluate(node.b) != 0;
      case Op::CHOICE: return evaluate(evaluate(node.a) != 0 ? node.b : node.c);
      case Op::CHECK: {
        const int64_t result = evaluate(node.a);
        const Range& range = model_.ranges[node.c];
        if (result < range.low || result > range.high) throw CheckFailed{node.b, result};
        return result;
      }
      case Op::CHECK_NONZERO: {
        const int64_t result = evaluate(node.a);
        if (result == 0) throw CheckFailed{node.b, 0};
        return result;
      }
      case Op::CALL: return call(node);
      case Op::ASSIGN_VAR: {
        const int64_t result = evaluate(node.b);
        set(node.a, result);
        return result;
      }
      case Op::ASSIGN_ELEMENT: {
        const int64_t result = evaluate(node.c);
        set(static_cast<int32_t>(node.a + evaluate(node.b)), result);
        return result;
      }
      case Op::ASSIGN_LOCAL: {
        const int64_t result = evaluate(node.b);
        return frame_[node.a] = result;
      }
      case Op::ASSIGN_LOCAL_ELEMENT: {
        const int64_t result = evaluate(node.c);
        const int64_t element = evaluate(node.b);
        return frame_[node.a + element] = result;
      }
      case Op::AT: return at[node.a] == node.b;
      case Op::DEADLOCK: return is_deadlock;
      default: return arithmetic(node);
    }
  }

  // Evaluate the nodes of a list for their effect.
  void run(int32_t list) {
    const int32_t count = model_.lists[list];
    for (int32_t i = 1; i <= count; ++i) evaluate(model_.lists[list + i]);
  }

 private:
  struct Old {
    int32_t slot, old;
  };
  static constexpr int32_t kSmallFrame = 16;

  int64_t arithmetic(const Node& node) {
    const int64_t left = evaluate(node.a);
    const int64_t right = evaluate(node.b);
    switch (node.op) {
      case Op::ADD: return left + right;
      case Op::SUB: return left - right;
      case Op::MUL: return left * right;
      case Op::DIV: return left / right;
      case Op::MOD: return left % right;
      case Op::SHL: return left * (int64_t{1} << right);
      case Op::SHR: return left >> right;
      case Op::BIT_AND: return left & right;
      case Op::BIT_OR: return left | right;
      case Op::BIT_XOR: return left ^ right;
      case Op::MIN: return left < right ? left : right;
      case Op::MAX: return left > right ? left : right;
      case Op::EQ: return left == right;
      case Op::NE: return left != right;
      case Op::LT: return left < right;
      case Op::LE: return left <= right;
      case Op::GT: return left > right;
      default: return left >= right;
    }
  }

  void put(int32_t slot, int64_t to) {
    value[slot] = static_cast<int32_t>(to);
    const Field& field = layout_.variables()[slot];
    uint64_t& word = packed[field.word];
    word = (word & ~(field.ones << field.shift)) |
           (static_cast<uint64_t>(to - field.low) & field.ones) << field.shift;
  }

  int64_t call(const Node& node) {
    const Function& function = model_.functions[node.a];
    // Arguments are evaluated in the caller's frame, so the new one is made beside it.
    int64_t small[kSmallFrame] = {};
    std::vector<int64_t> large(function.frame > kSmallFrame ? function.frame : 0, 0);
    int64_t* fresh = large.empty() ? small : large.data();
    const int32_t* arguments = model_.lists.data() + node.b;
    for (int32_t i = 0; i < node.c; ++i) fresh[i] = evaluate(arguments[i]);
    if (depth_ == 0) passes_ = 0;
    Nested nested(*this, node.a, fresh);
    if (depth_ > 1) count(1);
    if (!model_.picks.empty() && model_.picks[node.a].family >= 0) {
      return pick(model_.picks[node.a]);
    }
    block(function.body);
    return returned_;
  }

  // Enters a function and leaves it again, also by an exception.
  struct Nested {
    Nested(Machine& machine, int32_t function, int64_t* frame)
        : machine_(machine), frame_(machine.frame_), function_(machine.function_) {
      machine.frame_ = frame;
      machine.function_ = function;
      machine.returned_ = 0;
      ++machine.depth_;
    }
    ~Nested() {
      machine_.frame_ = frame_;
      machine_.function_ = function_;
      --machine_.depth_;
    }
    Nested(const Nested&) = delete;
    Nested& operator=(const Nested&) = delete;

   private:
    Machine& machine_;
    int64_t* frame_;
    int32_t function_;
  };

  // What the function would return, and among whom it chose.
  int64_t pick(const Pick& pick) {
    int64_t lowest = pick.fallback;
    uint64_t names = 0;
    count(int64_t{pick.high} - pick.low + 1);
    for (int64_t name = pick.high; name >= pick.low; --name) {
      frame_[pick.slot] = name;
      if (evaluate(pick.condition) == 0) continue;
      names |= uint64_t{1} << name;
      lowest = name;
    }
    judge->picked(pick, names);
    return lowest;
  }

  // The list of what is forgotten where a process is: its length, then slots and values.
  const int32_t* resets(int32_t process) const {
    const Forgetting& forgetting = model_.forgettings[process];
    if (forgetting.resets.empty()) return nullptr;
    int32_t place = at[process] * forgetting.stride;
    for (const Control& control : forgetting.controls) {
      place += (value[control.slot] - control.low) * control.stride;
    }
    const int32_t list = forgetting.resets[place];
    return list < 0 ? nullptr : model_.lists.data() + list;
  }

  void count(int64_t passes) {
    passes_ += passes;
    if (passes_ > kMaxLoopSteps) throw Endless{function_};
  }

  // Run a block; true when it returned.
  bool block(int32_t offset) {
    const int32_t length = model_.lists[offset];
    for (int32_t i = 1; i <= length; ++i) {
      if (statement(model_.nodes[model_.lists[offset + i]])) return true;
    }
    return false;
  }

  bool statement(const Node& node) {
    switch (node.op) {
      case Op::EVALUATE: evaluate(node.a); return false;
      case Op::IF: return block(evaluate(node.a) != 0 ? node.b : node.c);
      case Op::WHILE:
        while (evaluate(node.a) != 0) {
          count(1);
          if (block(node.b)) return true;
        }
        return false;
      case Op::FOR: {
        const Range range = model_.ranges[node.b];
        count(int64_t{range.high} - range.low + 1);
        for (int64_t i = range.low; i <= range.high; ++i) {
          frame_[node.a] = i;
          if (block(node.c)) return true;
        }
        return false;
      }
      default: {  // RETURN
        const int64_t result = node.a < 0 ? 0 : evaluate(node.a);
        returned_ = result;
        return true;
      }
    }
  }

  const Model& model_;
  const Layout& layout_;

 public:
  std::vector<int32_t> at, value;
  std::vector<uint64_t> packed;
  bool is_deadlock = false;
  PickJudge* judge = nullptr;  // hears of picks; needed where the model has some

 private:
  std::vector<Old> undo_, moved_;
  int64_t* frame_ = nullptr;
  int32_t function_ = 0;
  int depth_ = 0;
  int64_t passes_ = 0, returned_ = 0;
};

}  // namespace core
