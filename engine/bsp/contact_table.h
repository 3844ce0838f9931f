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

  /// Fetches what ask() will look at, soon.
  void expect(uint32_t contact) const {
    const Contact& c = contacts_[contact];
    for (const Contact::End& e : {c.lower, c.upper}) {
      if (e.vertex != kNone) continue;
      e.on_p ? crossings_.expect(c.p, e.edge, c.q) : crossings_.expect(c.q, e.edge, c.p);
    }
  }
  [[nodiscard]] bool is_asked(uint32_t contact) const { return ends_[contact][0] != kNone; }
  /// Asks for the ends of a contact that is not coplanar.
  void ask(uint32_t contact) {
    if (is_asked(contact)) return;
    const Contact& c = contacts_[contact];
    const auto end = [&](const Contact::End& e) {
      if (e.vertex != kNone) return index_.unique(geometry_.vertex_point(e.vertex));
      return kIsCrossing |
             (e.on_p ? crossings_.number(c.p, e.edge, c.q) : crossings_.number(c.q, e.edge, c.p));
    };
    ends_[contact] = {end(c.lower), end(c.upper)};
    asked_.push_back(contact);
  }
  /// Makes all points that were asked for, on several threads.
  void make() {
    crossings_.make_points();
    for (const uint32_t contact : asked_) {
      for (uint32_t& end : ends_[contact]) {
        if (end & kIsCrossing) end = crossings_.point(end & ~kIsCrossing);
      }
    }
    asked_.clear();
  }
  /// The points at the ends of a contact, lower and upper, in the geometry: those of the index.
  [[nodiscard]] const std::array<uint32_t, 2>& of(uint32_t contact) const { return ends_[contact]; }

 private:
  static constexpr uint32_t kIsCrossing = 1u << 31;

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
