// Broken files, broken devices, too little memory, and being killed at any moment: the program ends with an exit code
// and a reason, the target is the old file or the complete new one, and nothing else is left behind.
#include <sys/resource.h>

#include <array>
#include <thread>

#include "cli/program_test.h"

namespace unsnarl::cli {
namespace {

constexpr std::array<const char*, 13> formats = {"obj", "off", "ply", "stl", "glb", "gltf", "surf",
                                                 "gii", "vtk", "vtp", "msh", "inp", "3mf"};

/// For RunOptions::in_child.
std::function<void()> with_limit(int resource, rlim_t limit) {
  return [=] {
    const rlimit both = {limit, limit};
    ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
  };
}

/// Many bytes in a fixed order, the same on every machine.
std::string random_bytes(std::size_t size) {
  std::string bytes;
  std::uint64_t state = 1;
  while (bytes.size() < size) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    bytes += static_cast<char>(state >> 56);
  }
  return bytes;
}

using Hostile = ProgramTest;

std::string repeated(const std::string& part, std::size_t size) {
  std::string bytes;
  while (bytes.size() < size) bytes += part;
  return bytes;
}

TEST_F(Hostile, absurd_counts_are_refused_and_ask_for_no_memory) {
  const std::string ply_header =
      "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
      "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string list =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint float w\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string faces =
      "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
      "property float y\nproperty float z\nelement face 4294967295\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"data:;base64,AAAAAA=="}],
          "bufferViews":[{"buffer":0,"byteLength":4}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
          "accessors":[{"bufferView":0,"componentType":5126,"count":4000000000,"type":"VEC3"}]})";
  const std::string glb = std::string("glTF\2\0\0\0\xFF\xFF\xFF\xFF", 12) + std::string(
                                                                                "\xFF\xFF\xFF\xFF"
                                                                                "JSON",
                                                                                8);
  // A stream of zlib that could hold a thousand times its size, but not this.
  const std::string gifti =
      R"(<GIFTI><DataArray Intent="NIFTI_INTENT_POINTSET" DataType="NIFTI_TYPE_FLOAT32" Dimensionality="2" Dim0="400000"
          Dim1="3" Encoding="GZipBase64Binary" Endian="LittleEndian"><Data>eJwDAAAAAAE=</Data></DataArray></GIFTI>)";
  const std::string vtp =
      R"(<VTKFile type="PolyData" byte_order="LittleEndian" compressor="vtkZLibDataCompressor"><PolyData>
          <Piece NumberOfPoints="400000"><Points><DataArray type="Float32" NumberOfComponents="3" format="binary">
          AQAAAP///38AAAAACAAAAA==eJwDAAAAAAE=</DataArray></Points></Piece></PolyData></VTKFile>)";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"vertices.ply", ply_header + "0 0 0\n"},
      {"list.ply", list + std::string("\xFF\xFF\xFF\xFF", 4) + std::string(20, '\0')},
      {"faces.ply", faces},
      {"vertices.off", "OFF\n4294967295 1 0\n0 0 0\n"},
      {"faces.off", "OFF\n1 4294967295 0\n0 0 0\n3 0 0 0\n"},
      {"corners.off", "OFF\n1 1 0\n0 0 0\n4294967295 0 0 0\n"},
      {"facets.stl", std::string(80, 'x') + std::string(4, '\xFF') + std::string(100, '\0')},
      {"none.stl", std::string(1000, '\0')},
      {"vertex.obj", "v 0 0 0\nf 1 4294967295 1\n"},
      {"relative.obj", "v 0 0 0\nf -1 -4294967295 -1\n"},
      {"count.gltf", gltf},
      {"length.glb", glb},
      {"counts.surf", "\xFF\xFF\xFE\n\n\x7F\xFF\xFF\xFF\x7F\xFF\xFF\xFF"},
      {"counts.pial", "\xFF\xFF\xFD\xFF\xFF\xFF\xFF\xFF\xFF"},
      {"rows.gii", gifti},
      {"points.vtk", "# vtk DataFile Version 3.0\n\nBINARY\nDATASET POLYDATA\nPOINTS 2000000000 double\n"},
      {"points.vtp", vtp},
      {"nodes.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4000000000\n1 0 0 0\n"},
      {"blocks.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n4000000000 4000000000 1 2\n"}};
  for (const auto& [name, bytes] : files) {
    RunOptions options;
    if (memory_can_be_limited) options.in_child = with_limit(RLIMIT_AS, rlim_t{1} << 30);
    const Outcome outcome = run({"check", file(name, bytes), "--threads", "1"}, options);
    EXPECT_EQ(outcome.exit_code, 3) << name << ": " << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  }
}

TEST_F(Hostile, garbage_is_refused_in_every_format) {
  constexpr std::size_t size = 1 << 18;
  const std::vector<std::string> kinds = {random_bytes(size),         std::string(size, '\0'),   std::string(size, ' '),
                                          std::string(size, '\n'),    std::string(size, '9'),    repeated("f 1 ", size),
                                          repeated("{\"a\":[", size), repeated("\xFF\xFE", size)};
  for (const char* format : formats) {
    const std::string path = folder / ("garbage." + std::string(format));
    for (const std::string& bytes : kinds)
      for (const char* prefix : {"", "OFF\n", "ply\n", "solid\n", "glTF\2"}) {
        write(path, prefix + bytes);
        const Outcome outcome = run({"check", path});
        EXPECT_EQ(outcome.exit_code, 3) << format << " " << prefix << bytes.substr(0, 10) << ": " << outcome.err;
        EXPECT_LT(outcome.err.size(), 400u);
      }
  }
}

TEST_F(Hostile, what_is_nested_too_deeply_is_refused) {
  const auto nested = [](const std::string& before, const std::string& open, const std::string& close,
                         const std::string& after) {
    constexpr std::size_t depth = 200000;
    return before + repeated(open, depth * open.size()) + repeated(close, depth * close.size()) + after;
  };
  const std::string mesh = file("in.obj", crossing), out = folder / "out";
  const std::string svg = file("deep.svg", nested("<svg><path d=\"M0 0L1 1\"/>", "<g>", "</g>", "</svg>"));
  const std::string plan = file("plan.json", nested("{\"agents\": ", "[", "]", "}"));
  const std::string start = file("start.json", nested("{\"agents\": [{\"start\": ", "{\"a\":", "}", "}]}"));
  const std::string curves = file("curves.json", nested("{\"curves\": ", "[", "]", "}"));
  const std::string report =
      file("report.json", nested("{\"schema\": \"unsnarl-report\", \"schema_version\": ", "[", "]", "}"));
  const std::string knot = file("knot.txt", "0 0 0\n1 0 0\n0 1 0\n");
  const std::string gltf = file("deep.gltf", nested("{\"asset\": ", "[", "]", "}"));
  const std::string vtp = file("deep.vtp", nested("<VTKFile>", "<PolyData>", "</PolyData>", "</VTKFile>"));
  const std::string gii = file("deep.gii", nested("<GIFTI>", "<DataArray>", "</DataArray>", "</GIFTI>"));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"curves", svg, "-o", out},
                                             {"isotopy", svg, svg, "-o", out},
                                             {"curves", curves, "-o", out},
                                             {"routes", plan, "-o", out},
                                             {"routes", start, "-o", out},
                                             {"knot-isotopy", knot, knot, "--check", plan},
                                             {"view", mesh, "--report", report, "-o", folder / "out.html"},
                                             {"fix", gltf, "-o", out},
                                             {"check", vtp},
                                             {"check", gii}}) {
    SCOPED_TRACE(arguments[0] + " " + arguments[1]);
    expect_refusal(arguments, 3, "nested too deeply");
  }
  const Outcome batch = run({"batch", folder / ".", "-o", out, "--format", "gltf"});
  EXPECT_LT(batch.exit_code, 70) << batch.err;
}

TEST_F(Hostile, folders_and_pipes_as_inputs_are_refused_at_once) {
  for (const char* format : formats) {
    const std::string directory = folder / ("d." + std::string(format)), pipe = folder / ("p." + std::string(format));
    fs::create_directory(directory);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_EQ(run({"check", directory}).exit_code, 3);
    const Outcome outcome = run({"check", pipe});  // nobody will ever write to it
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.err.find("not a regular file"), std::string::npos) << outcome.err;
  }
}

TEST_F(Hostile, a_pipe_as_output_gets_the_whole_file) {
  const std::string in = file("in.obj", crossing), out = folder / "out.obj";
  EXPECT_EQ(run({"fix", in, "-o", out}).exit_code, 0);
  const std::string pipe = folder / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = contents(pipe); });
  EXPECT_EQ(run({"fix", in, "-o", pipe}).exit_code, 0);
  reader.join();
  EXPECT_EQ(received, contents(out));
}

TEST_F(Hostile, a_full_disk_keeps_the_old_file) {
  const std::string in = file("in.obj", crossing), out = file("out.obj", "precious");
  const auto before = folder.names();
  for (const rlim_t room : {0, 1, 100}) {
    const Outcome outcome = run({"fix", in, "-o", out, "--quiet"}, {.in_child = with_limit(RLIMIT_FSIZE, room)});
    EXPECT_EQ(outcome.exit_code, 4) << room;
    EXPECT_EQ(contents(out), "precious");
    EXPECT_EQ(folder.names(), before);
  }
}

TEST_F(Hostile, write_protection_is_respected) {
  const std::string in = file("in.obj", crossing), out = file("out.obj", "precious");
  const RunOptions options = {.in_child = respect_permissions};
  fs::permissions(out, fs::perms(0444));
  for (const auto& arguments :
       {std::vector<std::string>{"fix", in, "-o", out}, {"fix", in, "-o", folder / "new.obj", "--report", out}}) {
    const Outcome outcome = run(arguments, options);
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("write-protected"), std::string::npos) << outcome.err;
    EXPECT_EQ(contents(out), "precious");
  }
  const std::string locked = folder / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms(0555));
  EXPECT_EQ(run({"fix", in, "-o", locked + "/out.obj"}, options).exit_code, 4);
  EXPECT_TRUE(fs::is_empty(locked));
  const std::string secret = file("secret.obj", crossing);
  fs::permissions(secret, fs::perms(0444));
  EXPECT_EQ(run({"fix", secret, "--in-place"}, options).exit_code, 4);
  EXPECT_EQ(contents(secret), crossing);
}

TEST_F(Hostile, standard_streams_may_be_closed_or_full) {
  const std::string in = file("in.obj", crossing), expected = folder / "expected.obj", out = folder / "out.obj";
  ASSERT_EQ(run({"fix", in, "-o", expected}).exit_code, 0);
  const std::array<std::function<void()>, 4> streams = {
      [] { ::close(STDIN_FILENO), ::close(STDOUT_FILENO), ::close(STDERR_FILENO); }, [] { ::close(STDERR_FILENO); },
      [] { ::close(STDOUT_FILENO); }, [] { ::dup2(::open("/dev/full", O_WRONLY), STDERR_FILENO); }};
  for (const auto& prepare : streams) {
    EXPECT_EQ(run({"fix", in, "-o", out, "--progress", "json"}, {.in_child = prepare}).exit_code, 0);
    EXPECT_EQ(contents(out), contents(expected));
    EXPECT_EQ(run({"fix", folder / "missing.obj", "-o", out}, {.in_child = prepare}).exit_code, 3);
    fs::remove(out);
  }
  EXPECT_EQ(run({"fix", in, "-o", "-"}, {.in_child = [] { ::close(STDOUT_FILENO); }}).exit_code, 4);
  EXPECT_EQ(contents(in), crossing);
}

TEST_F(Hostile, killed_at_any_moment_the_target_is_the_old_file_or_the_new_one) {
  const std::string in = sample("folded_sheet", {"--resolution", "20"}), out = folder / "out.obj",
                    report = folder / "report.json";
  const std::string input = contents(in), old = "precious";
  ASSERT_EQ(run({"fix", in, "-o", out}).exit_code, 0);
  const std::string complete = contents(out);
  const auto expect_whole = [&](const RunOptions& options) {
    write(out, old);
    const Outcome outcome = run({"fix", in, "-o", out, "--report", report, "--progress", "json"}, options);
    const bool is_polite = options.signal != SIGKILL;
    const bool has_ended_well = outcome.exit_code == 0 || outcome.exit_code == 6;
    EXPECT_TRUE(has_ended_well || outcome.exit_code == -options.signal) << outcome.exit_code << outcome.err;
    EXPECT_TRUE(contents(out) == old || contents(out) == complete);
    EXPECT_TRUE(outcome.exit_code != 0 || contents(out) == complete);
    EXPECT_EQ(contents(in), input);
    for (const std::string& name : folder.names()) {
      const bool is_ours = name == "out.obj" || name == "report.json" || name == fs::path(in).filename();
      const bool is_kept = name == "out.partial.obj";  // what was reached
      EXPECT_TRUE(is_ours || is_kept || !is_polite) << "left behind: " << name;
      EXPECT_TRUE(!is_kept || pairs_in(folder / name) <= pairs_in(in));
      if (!is_ours) fs::remove_all(folder / name);
    }
    fs::remove(report);
  };
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    for (const char* phase : {"untangle", "certify", "\"fraction\":1"})
      expect_whole({.signal_after = {phase}, .signal = signal});
    for (int us = 0; us < 200'000; us = us * 2 + 500) expect_whole({.signal = signal, .signal_after_us = us});
  }
}

TEST_F(Hostile, too_little_memory_is_no_crash) {
  if (!memory_can_be_limited) GTEST_SKIP() << "the sanitizer needs all addresses";
  const std::string in = sample("folded_sheet", {"--resolution", "30"}), out = file("out.obj", "precious");
  const auto before = folder.names();
  bool ran_out = false;
  for (rlim_t mb = 16; mb <= 60; mb += mb < 40 ? 2 : 10) {
    const RunOptions options = {.in_child = with_limit(RLIMIT_AS, mb << 20)};
    // The program cannot complain where the libraries it loads before main find no room.
    if (run({"--version"}, options).exit_code != 0) continue;
    const Outcome outcome = run({"fix", in, "-o", out, "--threads", "2", "--quiet"}, options);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 5 || outcome.exit_code == 9)
        << mb << " MB: " << outcome.exit_code << outcome.err;
    ran_out |= outcome.err.find("memory") != std::string::npos;
    EXPECT_EQ(folder.names(), before);
  }
  EXPECT_TRUE(ran_out);
}

}  // namespace
}  // namespace unsnarl::cli
