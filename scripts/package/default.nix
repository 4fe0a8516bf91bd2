# libmeniscus with its headers, from nixpkgs: nix-build scripts/package
{ pkgs ? import <nixpkgs> { } }:
pkgs.stdenv.mkDerivation {
  pname = "libmeniscus";
  version = "0.3.0";
  src = ../..;
  nativeBuildInputs = with pkgs; [ cmake ninja pkg-config ];
  buildInputs = with pkgs; [ glm fmt (pkgs.onetbb or tbb_2021) gemmi zlib freetype nlohmann_json libdeflate ]
    ++ lib.optional stdenv.hostPlatform.isLinux libepoxy;
  # nixpkgs' own are absolute, and meniscus.pc and the CMake package tell places from theirs.
  cmakeFlags = [ "-DMENISCUS_APP=OFF" "-DCMAKE_INSTALL_LIBDIR=lib" "-DCMAKE_INSTALL_INCLUDEDIR=include"
    "-DMENISCUS_FONTS=${pkgs.liberation_ttf}/share/fonts/truetype" ];
  meta = {
    description = "Exact solvent-excluded surfaces of molecules";
    license = pkgs.lib.licenses.bsd3;
  };
}
