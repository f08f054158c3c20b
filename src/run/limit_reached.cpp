#include "unsnarl/limit_reached.h"

#include <string>

namespace unsnarl {

LimitReached::LimitReached(Status status)
    : std::runtime_error(std::string(status == Status::memory_limit ? "the memory limit" : "the time limit") +
                         " was reached before all self-intersections of the input were found"),
      status_(status) {}

}  // namespace unsnarl
