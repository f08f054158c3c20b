#pragma once

namespace unsnarl::app {

/// Processors that this process may use.
int processors();

/// Memory that this process may use, in MB (10^6 bytes): what the machine has, or the control group of the process (a
/// Slurm job, a container) allows.
double memory_mb();

}  // namespace unsnarl::app
