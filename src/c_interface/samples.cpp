#include "unsnarl/samples.h"

#include <nlohmann/json.hpp>

#include "results.h"

namespace unsnarl::c_interface {
namespace {

std::map<std::string, double> parameters_of(const char* text) {
  if (text == nullptr) return {};
  const Json given = Json::parse(text, nullptr, false);
  if (!given.is_object()) throw std::invalid_argument("parameters is no JSON object of numbers by their names");
  std::map<std::string, double> parameters;
  for (const auto& [name, value] : given.items()) {
    if (!value.is_number()) throw std::invalid_argument("parameters: " + name + " is no number");
    parameters[name] = value.get<double>();
  }
  return parameters;
}

Json json_of(const Sample& sample) {
  Json parameters = Json::array();
  for (const SampleParameter& p : sample.parameters)
    parameters.push_back({{"name", p.name},
                          {"value", p.value},
                          {"minimum", p.minimum},
                          {"maximum", p.maximum},
                          {"description", p.description}});
  return {{"name", sample.name},
          {"description", sample.description},
          {"embeddable", sample.embeddable},
          {"parameters", std::move(parameters)}};
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_sample(const char* name, int32_t resolution, const char* parameters, unsnarl_result** result) {
  return hand_out(result, [&] {
    require(name, "name");
    Surface surface = make_sample(name, resolution, parameters_of(parameters));
    unsnarl_result made;
    made.arrays["positions"] = {std::move(surface.positions), 3};
    made.arrays["corners"] = {std::move(surface.corners)};
    made.arrays["offsets"] = {std::move(surface.offsets)};
    return made;
  });
}

int unsnarl_list_samples(unsnarl_result** result) {
  return hand_out(result, [] {
    Json list = Json::array();
    for (const Sample& sample : all_samples()) list.push_back(json_of(sample));
    unsnarl_result found;
    found.report = list.dump();
    return found;
  });
}
