#pragma once

#include <vector>

#include "batch/folder.h"
#include "batch/record.h"
#include "interruption.h"

namespace unsnarl::app {

/// Writes results.jsonl, results.csv and index.html, which follow from the records without "run" alone and are the same
/// bytes whatever the order of the work; and timing.csv and timing.js, which the page shows where they are. Records:
/// one a mesh, in the order to be shown. Throws WriteError.
void write_batch_summary(const BatchFolder& folder, const std::vector<Record>& records, Interruption& interruption);

}  // namespace unsnarl::app
