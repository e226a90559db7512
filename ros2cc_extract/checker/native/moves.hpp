// Successors of the state in a machine, in the order of semantics.py.
#pragma once

#include <cstdint>
#include <vector>

#include "machine.hpp"
#include "symmetry.hpp"

namespace core {

class Moves {
 public:
  Moves(const Model& model, Machine& machine)
      : model_(model), machine_(machine), symmetry_(model, machine, moving_) {
    std::vector<std::vector<int32_t>> leaving;
    for (const auto& flags : model.locations) {
      base_.push_back(static_cast<int32_t>(flags_.size()));
      flags_.insert(flags_.end(), flags.begin(), flags.end());
    }
    leaving.resize(flags_.size());
    receivers_.resize(model.channels.size());
    for (size_t e = 0; e < model.edges.size(); ++e) {
      const Edge& edge = model.edges[e];
      const int32_t number = static_cast<int32_t>(e);
      if (edge.sync != RECEIVE) {
        leaving[base_[edge.process] + edge.source].push_back(number);
      } else {
        for (int32_t c = 0; c < edge.length; ++c) {
          receivers_[edge.channel + c].push_back(number);
        }
      }
    }
    for (const auto& edges : leaving) {
      first_.push_back(static_cast<int32_t>(leaving_.size()));
      leaving_.insert(leaving_.end(), edges.begin(), edges.end());
    }
    first_.push_back(static_cast<int32_t>(leaving_.size()));
  }

  // Calls visit(edges) for each transition while its target is in the machine; the machine is
  // back in the state `words`, which was loaded before, afterwards.
  template <class Visit>
  void each(const uint64_t* words, Visit&& visit) {
    committed_ = 0;
    for (size_t p = 0; p < machine_.at.size(); ++p) {
      if (flags(p) & COMMITTED) ++committed_;
    }
    symmetry_.note_source();
    for (size_t p = 0; p < machine_.at.size(); ++p) {
      // Moves change the location while they are visited, so it is read once.
      const int32_t place = base_[p] + machine_.at[p];
      for (int32_t i = first_[place]; i < first_[place + 1]; ++i) {
        from(leaving_[i], words, visit);
      }
    }
  }

  bool stops_time() const {
    for (size_t p = 0; p < machine_.at.size(); ++p) {
      if (flags(p)) return true;
    }
    return false;
  }

  // Whether a process is committed after the transition that is visited.
  bool leads_to_committed(const Edges& edges) const {
    int32_t left = committed_;
    for (const int32_t number : edges) {
      const Edge& edge = model_.edges[number];
      const int32_t* flags = &flags_[base_[edge.process]];
      if (flags[edge.source] & COMMITTED) --left;
      if (flags[edge.target] & COMMITTED) ++left;
    }
    return left > 0;
  }

  bool is_urgent(const Edges& edges) const {
    const Edge& edge = model_.edges[edges[0]];
    return edge.sync != NO_SYNC && (model_.channels[edge.channel] & URGENT_CHANNEL);
  }

 private:
  int32_t flags(size_t process) const {
    return flags_[base_[process] + machine_.at[process]];
  }

  bool leaves_committed(int32_t edge) const {
    return flags(model_.edges[edge].process) & COMMITTED;
  }

  bool enabled(const Edge& edge) {
    return edge.guard < 0 || machine_.evaluate(edge.guard) != 0;
  }

  int32_t channel(const Edge& edge) {
    if (edge.index < 0) return edge.channel;
    return static_cast<int32_t>(edge.channel + machine_.evaluate(edge.index));
  }

  template <class Visit>
  void from(int32_t number, const uint64_t* words, Visit&& visit) {
    const Edge& edge = model_.edges[number];
    moving_.assign(1, number);
    symmetry_.begin_step();
    if (edge.sync == NO_SYNC) {
      if (committed_ > 0 && !leaves_committed(number)) return;
      if (!enabled(edge)) return;
      take(words, visit);
      return;
    }
    if (!enabled(edge)) return;
    const int32_t at = channel(edge);
    if (symmetry_.is_uneven()) {
      if (is_held_back(number)) return;
      throw Uneven{};
    }
    if (model_.channels[at] & BROADCAST) {
      broadcast(number, at, words, visit);
    } else {
      binary(number, at, words, visit);
    }
  }

  // Whether a sender has to wait for others, whichever channel it chooses.
  bool is_held_back(int32_t sender) const {
    if (committed_ == 0 || leaves_committed(sender)) return false;
    const Edge& edge = model_.edges[sender];
    for (int32_t c = edge.channel; c < edge.channel + edge.length; ++c) {
      for (const int32_t receiver : receivers_[c]) {
        const Edge& other = model_.edges[receiver];
        if (machine_.at[other.process] == other.source && leaves_committed(receiver)) return false;
      }
    }
    return true;
  }

  bool can_receive(int32_t number, int32_t sender, int32_t at) {
    const Edge& edge = model_.edges[number];
    if (edge.process == model_.edges[sender].process) return false;
    if (machine_.at[edge.process] != edge.source || !enabled(edge)) return false;
    return edge.index < 0 || channel(edge) == at;
  }

  template <class Visit>
  void binary(int32_t sender, int32_t at, const uint64_t* words, Visit&& visit) {
    for (const int32_t receiver : receivers_[at]) {
      if (committed_ > 0 && !leaves_committed(sender) && !leaves_committed(receiver)) continue;
      if (!can_receive(receiver, sender, at)) continue;
      moving_.assign(1, sender);
      moving_.push_back(receiver);
      take(words, visit);
    }
  }

  template <class Visit>
  void broadcast(int32_t sender, int32_t at, const uint64_t* words, Visit&& visit) {
    // Receivers that are ready, grouped by process; one of each group takes part.
    std::vector<std::vector<int32_t>> ready;
    int32_t last = -1;
    for (const int32_t receiver : receivers_[at]) {
      if (!can_receive(receiver, sender, at)) continue;
      const int32_t process = model_.edges[receiver].process;
      if (process != last) ready.emplace_back();
      last = process;
      ready.back().push_back(receiver);
    }
    std::vector<size_t> chosen(ready.size(), 0);
    while (true) {
      moving_.assign(1, sender);
      bool is_allowed = committed_ == 0 || leaves_committed(sender);
      for (size_t i = 0; i < ready.size(); ++i) {
        moving_.push_back(ready[i][chosen[i]]);
        is_allowed = is_allowed || leaves_committed(moving_.back());
      }
      if (is_allowed) take(words, visit);
      size_t i = ready.size();
      while (i > 0 && ++chosen[i - 1] == ready[i - 1].size()) chosen[--i] = 0;
      if (i == 0) return;
    }
  }

  template <class Visit>
  void take(const uint64_t* words, Visit&& visit) {
    const Symmetry::Last picked = symmetry_.last();
    for (const int32_t number : moving_) {
      const Edge& edge = model_.edges[number];
      if (edge.source != edge.target) machine_.move(edge.process, edge.target);
      if (edge.updates >= 0) machine_.run(edge.updates);
    }
    if (!model_.forgettings.empty()) {
      for (const int32_t number : moving_) machine_.forget(model_.edges[number].process);
    }
    if (!model_.families.empty()) {
      if (symmetry_.is_uneven()) throw Uneven{};
      symmetry_.order();
      symmetry_.back_to(picked);
    }
    visit(moving_);
    machine_.restore(words);
  }

  const Model& model_;
  Machine& machine_;
  // Locations of all processes are numbered through: `base_` is the first of each process.
  std::vector<int32_t> base_, flags_;
  std::vector<int32_t> first_, leaving_;         // edges that do not wait for a sender
  std::vector<std::vector<int32_t>> receivers_;  // by channel
  Edges moving_;
  Symmetry symmetry_;
  int32_t committed_ = 0;
};

}  // namespace core
