// The tables of a network as the core sees them: integers only, no names.
#pragma once

#include <cstdint>
#include <vector>

namespace core {

// One list names the operations for both sides: binding.cpp hands it to Python.
#define CORE_OPERATIONS(X)                                                                      \
  X(CONST) X(VAR) X(ELEMENT) X(TABLE) X(LOCAL) X(LOCAL_ELEMENT) X(NEG) X(NOT) X(ADD) X(SUB)      \
  X(MUL) X(DIV) X(MOD) X(SHL) X(SHR) X(BIT_AND) X(BIT_OR) X(BIT_XOR) X(MIN) X(MAX) X(EQ) X(NE)   \
  X(LT) X(LE) X(GT) X(GE) X(AND) X(OR) X(CHOICE) X(CHECK) X(CHECK_NONZERO) X(CALL)               \
  X(ASSIGN_VAR) X(ASSIGN_ELEMENT) X(ASSIGN_LOCAL) X(ASSIGN_LOCAL_ELEMENT) X(AT) X(DEADLOCK)      \
  X(VAR_IS) X(EVALUATE) X(IF) X(WHILE) X(FOR) X(RETURN)

enum class Op : int32_t {
#define CORE_ENUM(name) name,
  CORE_OPERATIONS(CORE_ENUM)
#undef CORE_ENUM
};

// An expression or statement; what a, b and c mean depends on the operation (native_tables.py).
struct Node {
  Op op;
  int32_t a, b, c;
};

struct Function {
  int32_t frame;
  int32_t body;  // offset of a block in Model::lists: its length, then its statements
};

enum SyncKind : int32_t { NO_SYNC = 0, SEND = 1, RECEIVE = 2 };

struct Edge {
  int32_t process, source, target;
  int32_t guard;    // node or -1
  int32_t sync;     // SyncKind
  int32_t channel;  // first channel it may use
  int32_t length;   // how many channels it may use
  int32_t index;    // node that chooses among them, -1 when there is one
  int32_t updates;  // offset of a list of nodes
};

// Thrown when a run-time check fails, or a function's loops do not end.
struct CheckFailed {
  int32_t site;
  int64_t value;
};
struct Endless {
  int32_t function;
};

enum LocationFlag : int32_t { URGENT = 1, COMMITTED = 2 };
enum ChannelFlag : int32_t { BROADCAST = 1, URGENT_CHANNEL = 2 };

struct Range {
  int32_t low, high;
};

// What may be forgotten once a process has arrived somewhere: see dead_variables.py. The place is its
// location and the values of its controls, counted through as one number.
struct Control {
  int32_t slot, low, stride;
};
struct Forgetting {
  std::vector<Control> controls;
  int32_t stride = 0;          // of the location
  std::vector<int32_t> resets;  // by place: offset of a list of slots and values, or -1
};

// Processes that differ in nothing but their name: see symmetry.py.
struct Pointer {
  int32_t slot, initial;
  std::vector<int32_t> owners;  // processes that may forget it
};
struct Family {
  std::vector<int32_t> processes, names;
  std::vector<std::vector<int32_t>> parts;  // slots of each member, in the same order
  std::vector<Pointer> pointers;            // slots whose value is a name
};

// A function that returns the lowest name for which a condition holds.
struct Pick {
  int32_t family;  // -1: the function is no such one
  int32_t slot, low, high, condition, fallback;
};

// Thrown when a pick was among members that can be told apart.
struct Uneven {};

struct Model {
  std::vector<Node> nodes;
  std::vector<int32_t> lists;
  std::vector<Range> ranges;
  std::vector<Function> functions;
  std::vector<Edge> edges;  // by process, then as in the template
  std::vector<int32_t> channels;
  std::vector<Range> variables;
  std::vector<int32_t> initial;                   // locations, then variables
  std::vector<std::vector<int32_t>> locations;    // flags, by process
  std::vector<Forgetting> forgettings;            // by process; empty: nothing is forgotten
  std::vector<Family> families;
  std::vector<Pick> picks;                        // by function; empty: there is none
};

// A predicate over states and the variables and locations it may read.
struct Predicate {
  int32_t node;
  bool reads_deadlock;
  std::vector<int32_t> variables, processes;
};

}  // namespace core
