# libmeniscus with its headers, from Homebrew's packages. Liberation Sans is not one of them: letters need a font file.
# A released source does not exist yet, so a clone is named:
#   HOMEBREW_MENISCUS_CLONE=$PWD brew install --HEAD scripts/package/meniscus.rb
class Meniscus < Formula
  desc "Exact solvent-excluded surfaces of molecules"
  license "BSD-3-Clause"
  head ENV.fetch("HOMEBREW_MENISCUS_CLONE"), using: :git

  depends_on "cmake" => :build
  depends_on "glm" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pegtl" => :build
  depends_on "pkgconf" => :build
  depends_on "fmt"
  depends_on "freetype"
  depends_on "gemmi"
  depends_on "libdeflate"
  depends_on "tbb"
  uses_from_macos "zlib"
  on_linux do
    depends_on "libepoxy"
  end

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DMENISCUS_APP=OFF",
           "-DMENISCUS_GL=#{OS.mac? ? "OFF" : "ON"}", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    (testpath/"version.c").write <<~C
      #include <meniscus/meniscus.h>
      #include <stdio.h>
      int main(void) { return puts(meniscus_version()) < 0; }
    C
    system ENV.cc, "version.c", "-I#{include}", "-L#{lib}", "-lmeniscus", "-o", "version"
    assert_match(/^\d+\.\d+\.\d+$/, shell_output("./version"))
  end
end
