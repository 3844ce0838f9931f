// The contacts of each polygon, and the points at their ends.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/bsp/crossing_points.h"
#include "engine/bsp/find_contacts.h"

namespace csgrun {

class ContactTable {
 public:
  ContactTable() = default;
  ContactTable(Contacts found, size_t polygon_count)
      : contacts_(std::move(found.contacts)),
        touched_(std::move(found.touched)),
        in_flat_corner_(std::move(found.in_flat_corner)) {
    by_polygon_.sort(2 * contacts_.size(), polygon_count, [&](size_t side) {
      const Contact& c = contacts_[side / 2];
      return side % 2 == 0 ? c.p : c.q;
    });
    for (uint32_t& side : by_polygon_.order) side /= 2;
  }

  [[nodiscard]] const RawVector<Contact>& all() const { return contacts_; }
  [[nodiscard]] const Contact& operator[](uint32_t contact) const { return contacts_[contact]; }
  /// The numbers of a polygon's contacts.
  [[nodiscard]] std::span<const uint32_t> of(uint32_t polygon) const {
    const std::vector<uint32_t>& starts = by_polygon_.starts;
    return {by_polygon_.order.data() + starts[polygon], starts[polygon + 1] - starts[polygon]};
  }
  /// Per vertex of the job, whether it may be on another operand's surface.
  [[nodiscard]] const std::vector<uint8_t>& touched() const { return touched_; }

  /// Whether a polygon has no more than a corner in common with a coplanar one, which is no
  /// contact.
  [[nodiscard]] bool is_in_flat_corner(uint32_t polygon) const {
    return in_flat_corner_[polygon] != 0;
  }
  [[nodiscard]] bool is_met(uint32_t polygon) const {
    return is_in_flat_corner(polygon) || !of(polygon).empty();
  }

 private:
  RawVector<Contact> contacts_;
  std::vector<uint8_t> touched_, in_flat_corner_;
  CountingOrder by_polygon_;  ///< of the contacts' sides, two each
};

/// Names for the ends of contacts, as they are asked for.
class ContactEnds {
 public:
  ContactEnds(const ContactTable& contacts, Job& job, CellGeometry& geometry, PointIndex& index)
      : contacts_(contacts),
        geometry_(geometry),
        index_(index),
        crossings_(job, geometry, index),
        ends_(contacts.all().size(), {kNone, kNone}) {
    name_vertices();
  }

  [[nodiscard]] bool is_asked(uint32_t contact) const { return ends_[contact][0] != kNone; }
  /// Asks for the ends of contacts that are not coplanar, each of which was not asked for before.
  void ask(std::span<const uint32_t> contacts) {
    ask_vertices(contacts);
    ask_crossings(contacts);
  }
  /// The first half of that: for ends that are vertices.
  void ask_vertices(std::span<const uint32_t> contacts) {
    const auto list = [&](size_t begin, size_t end, std::vector<uint32_t>& out) {
      for (const uint32_t contact : contacts.subspan(begin, end - begin)) {
        const Contact& c = contacts_[contact];
        if (c.lower.vertex != kNone || c.upper.vertex != kNone) out.push_back(contact);
      }
    };
    for (const uint32_t contact : list_in_parts<uint32_t>(contacts.size(), kFewForThreads, list)) {
      for (size_t side = 0; side < 2; ++side) {
        const uint32_t vertex = end_of(contact, side).vertex;
        if (vertex == kNone) continue;
        ends_[contact][side] = index_.unique(geometry_.vertex_point(vertex));
      }
    }
  }
  /// The other half. Looks at no plane.
  void ask_crossings(std::span<const uint32_t> contacts) {
    constexpr size_t kAhead = 8;
    asked_.insert(asked_.end(), contacts.begin(), contacts.end());
    crossings_.make_room(contacts.size());  // curves have as many points as segments
    for (size_t i = 0; i < contacts.size(); ++i) {
      for (size_t side = 0; side < 2; ++side) {
        if (i + kAhead < contacts.size()) {
          const uint32_t next = contacts[i + kAhead];
          if (end_of(next, side).vertex == kNone) crossings_.expect(place_of(next, side));
        }
        if (end_of(contacts[i], side).vertex != kNone) continue;
        ends_[contacts[i]][side] = kIsCrossing | crossings_.number(place_of(contacts[i], side));
      }
    }
  }
  /// Makes all points that were asked for, on several threads.
  void make() {
    crossings_.make_points();
    for_each_range(asked_.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        for (uint32_t& point : ends_[asked_[i]]) {
          if (point & kIsCrossing) point = crossings_.point(point & ~kIsCrossing);
        }
      }
    });
    asked_.clear();
  }
  /// The points at the ends of a contact, lower and upper, in the geometry: those of the index.
  [[nodiscard]] const std::array<uint32_t, 2>& of(uint32_t contact) const { return ends_[contact]; }

 private:
  static constexpr uint32_t kIsCrossing = 1u << 31;

  [[nodiscard]] const Contact::End& end_of(uint32_t contact, size_t side) const {
    const Contact& c = contacts_[contact];
    return side == 0 ? c.lower : c.upper;
  }
  /// Of an end that is no vertex.
  [[nodiscard]] CrossingPoints::Place place_of(uint32_t contact, size_t side) const {
    const Contact& c = contacts_[contact];
    const Contact::End& e = end_of(contact, side);
    return e.on_p ? CrossingPoints::Place{c.p, e.edge, c.q}
                  : CrossingPoints::Place{c.q, e.edge, c.p};
  }

  /// Most vertices that are touched are at the ends of contacts.
  void name_vertices() {
    const std::vector<uint32_t> vertices = numbers_where(
        contacts_.touched().size(), [&](uint32_t v) { return contacts_.touched()[v] != 0; });
    std::vector<uint32_t> points(vertices.size());
    std::iota(points.begin(), points.end(), geometry_.add_vertex_points(vertices));
    index_.make_unique(points);
  }

  const ContactTable& contacts_;
  CellGeometry& geometry_;
  PointIndex& index_;
  CrossingPoints crossings_;
  std::vector<std::array<uint32_t, 2>> ends_;
  std::vector<uint32_t> asked_;
};

}  // namespace csgrun
