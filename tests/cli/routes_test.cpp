#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace unsnarl::cli {
namespace {

const std::string crossing_agents =
    R"({"agents": [{"name": "a", "radius": 0.5, "start": [-4, 0, 0], "goal": [4, 0, 0]},
                   {"name": "b", "radius": 0.5, "start": [0, -4, 0], "goal": [0, 4, 0]}],
        "obstacles": [{"file": "wall.off"}]})";
const std::string wall_of_plan = "OFF\n4 1 0\n-1 -1 2\n1 -1 2\n1 1 2\n-1 1 2\n4 0 1 2 3\n";

TEST(RoutesCommand, routes_are_written_and_certified) {
  Folder folder;
  write(folder / "plan.json", crossing_agents);
  write(folder / "wall.off", wall_of_plan);
  const Outcome made = run({"routes", folder / "plan.json", "-o", folder / "out"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "2 routes, certified as written"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"plan.json", "wall.off", "out", "out/routes.json", "out/tubes.obj",
                                                   "out/animation.svg", "out/picture.png"}));
  EXPECT_EQ(run({"check", folder / "out/tubes.obj", "-q"}).exit_code, 0);
  EXPECT_TRUE(contains(contents(folder / "out/tubes.obj"), "\ng a\n"));
  auto routes = nlohmann::json::parse(contents(folder / "out/routes.json"));
  EXPECT_EQ(routes["hold"], true);
  EXPECT_GE(routes["clearance"], 1);
  EXPECT_EQ(run({"routes", folder / "plan.json", "--check", folder / "out/routes.json"}).exit_code, 0);
  EXPECT_EQ(run({"routes", folder / "plan.json", "-o", folder / "out"}).exit_code, 2);  // not empty
  routes["routes"][0]["points"] = nlohmann::json::parse("[[-4, 0, 0], [4, 0, 0]]");
  routes["routes"][1]["points"] = nlohmann::json::parse("[[0, -4, 0], [0, 4, 0]]");
  write(folder / "straight.json", routes.dump());
  const Outcome straight = run({"routes", folder / "plan.json", "--check", folder / "straight.json"});
  EXPECT_EQ(straight.exit_code, 1);
  EXPECT_TRUE(contains(straight.err, "the routes of 'a' and 'b' have 0 of the distance that they need"));
}

TEST(RoutesCommand, free_tubes_are_untangled_as_surfaces) {
  Folder folder;
  write(folder / "plan.json", crossing_agents);
  write(folder / "wall.off", wall_of_plan);
  const Outcome made = run({"routes", folder / "plan.json", "-o", folder / "out", "--free-tubes", "--sides", "8"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(run({"check", folder / "out/tubes.obj", "-q"}).exit_code, 0);
  EXPECT_EQ(folder.names(),
            (std::set<std::string>{"plan.json", "wall.off", "out", "out/tubes.obj", "out/picture.png"}));
}

TEST(RoutesCommand, errors_and_obstructions) {
  Folder folder;
  const auto said = [&](const std::string& plan, int exit_code) {
    const Outcome outcome = run({"routes", "-", "-o", folder / "out"}, {.input = plan});
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return outcome.err;
  };
  EXPECT_TRUE(contains(said("{\"agents\": 1}", 3), "-: agents: 1 is not a list"));
  EXPECT_TRUE(contains(said(crossing_agents, 3), "-: obstacles[0].file: "));
  const std::string near = R"({"agents": [{"name": "a", "radius": 1, "start": [0, 0, 0], "goal": [9, 0, 0]},
                                          {"name": "b", "radius": 1, "start": [0, 1, 0], "goal": [9, 9, 0]}]})";
  EXPECT_TRUE(contains(said(near, 7), "the start of 'a' and the start of 'b' are 1 apart"));
  EXPECT_TRUE(contains(said(R"({"agents": [{"radius": 1e-300, "start": [0, 0, 0], "goal": [1, 0, 0]}]})", 3),
                       "agents[0].radius is 1e-300, which is too small"));
  EXPECT_EQ(run({"routes", "-"}, {.input = near}).exit_code, 2);
  const std::string timed = R"({"timed": true, "agents": [{"radius": 1, "start": [0, 0, 0], "goal": [9, 0, 0]}]})";
  const Outcome free_in_time = run({"routes", "-", "-o", folder / "out", "--free-tubes"}, {.input = timed});
  EXPECT_EQ(free_in_time.exit_code, 2);
  EXPECT_TRUE(contains(free_in_time.err, "--free-tubes does not work with \"timed\""));
  EXPECT_EQ(run({"routes", folder / "none.json", "-o", folder / "out"}).exit_code, 3);
  EXPECT_EQ(run({"sample", "routes_maze", "-o", folder / "maze.json"}).exit_code, 0);
  EXPECT_EQ(run({"routes", folder / "maze.json", "-o", folder / "out", "--time-limit", "0.05"}).exit_code, 5);
  EXPECT_FALSE(fs::exists(folder / "out/routes.json"));
}

}  // namespace
}  // namespace unsnarl::cli
