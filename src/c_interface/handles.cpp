#include "handles.h"

#include <cstring>
#include <new>
#include <stdexcept>

#include "arguments.h"
#include "errors.h"

using namespace unsnarl::c_interface;

int unsnarl_options_init(unsnarl_options* options, size_t size) {
  return guarded([&] {
    require(options, "options");
    unsnarl_options defaults = default_options();
    check_size(size, sizeof defaults, "options");
    defaults.size = size;
    std::memcpy(options, &defaults, size);
  });
}

unsnarl_context* unsnarl_context_new(unsnarl_progress_function on_progress, void* data) {
  auto* const made = new (std::nothrow) unsnarl_context;
  if (made == nullptr || on_progress == nullptr) return made;
  const int code = guarded([&] {
    made->context.on_progress = [made, on_progress, data](const unsnarl::Context::Progress& report) {
      const std::string phase(report.phase);
      const unsnarl_progress progress = {sizeof progress, report.fraction, phase.c_str(), report.pairs_left,
                                         report.displacement_rel};
      if (on_progress(&progress, data) != 0) made->context.cancel();
    };
  });
  if (code == UNSNARL_OK) return made;
  delete made;
  return nullptr;
}

void unsnarl_context_cancel(unsnarl_context* context) {
  if (context != nullptr) context->context.cancel();
}

void unsnarl_context_free(unsnarl_context* context) {
  delete context;
}

const char* unsnarl_result_status(const unsnarl_result* result) {
  return result->status.c_str();
}

const char* unsnarl_result_report(const unsnarl_result* result) {
  return result->report.c_str();
}

int unsnarl_result_array(const unsnarl_result* result, const char* name, unsnarl_array* array) {
  return guarded([&] {
    require(result, "result");
    require(name, "name");
    require(array, "array");
    const auto found = result->arrays.find(std::string_view(name));
    if (found == result->arrays.end()) {
      std::string all;
      for (const auto& entry : result->arrays) all += (all.empty() ? "'" : ", '") + entry.first + "'";
      throw std::invalid_argument("there is no array '" + std::string(name) + "' in this result; it has " +
                                  (all.empty() ? "none" : all));
    }
    const auto& [values, columns] = found->second;
    std::visit(
        [&, columns = columns, type = values.index()](const auto& vector) {
          *array = {vector.data(), vector.size() / columns, columns, static_cast<unsnarl_type>(type)};
        },
        values);
  });
}

void unsnarl_result_free(unsnarl_result* result) {
  delete result;
}
