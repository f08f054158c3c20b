class Unsnarl < Formula
  desc "Removes self-intersections from surface meshes, connectivity kept"
  homepage "@HOMEPAGE@"
  url "@HOMEPAGE@/releases/download/v@VERSION@/unsnarl-@VERSION@.tar.gz"
  sha256 "@SHA256@"
  license "Apache-2.0"

  depends_on "boost" => :build
  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "eigen@3" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "fmt"
  depends_on "giflib"
  depends_on "libpng"
  depends_on "libzip"
  depends_on "pugixml"
  depends_on "tbb"

  uses_from_macos "python" => :build
  uses_from_macos "zlib"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DUNSNARL_BUILD_TESTS=OFF",
           *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"unsnarl", "sample", "crossing_tubes", "-o", "in.obj"
    system bin/"unsnarl", "fix", "in.obj", "-o", "out.obj"
    system bin/"unsnarl", "check", "out.obj"
    assert_match version.to_s, shell_output("#{bin}/unsnarl --version")
  end
end
