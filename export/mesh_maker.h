// Where encoders get their meshes: rounded, and checked and repaired if that was asked for.
#pragma once

#include <csgrun/engine/error.h>
#include <csgrun/export/write.h>

#include "export/rounding.h"

namespace csgrun {

class MeshMaker {
 public:
  /// The report must outlive it.
  MeshMaker(const WriteOptions& options, WriteReport& report)
      : options_(options), report_(report) {}

  /// The mesh of a part as it is to be written; see round_part. With a check, its verdict goes into
  /// the report, and bent outlines are left out.
  Result<RoundedMesh> make(const Part& part, const Affine& placement, Precision precision,
                           bool with_outlines);
  /// Appends to the report what rounding did to the meshes so far; once, when all are made.
  void report_rounding() { totals_.report(report_); }

 private:
  WriteOptions options_;
  WriteReport& report_;
  RoundingTotals totals_;
};

}  // namespace csgrun
