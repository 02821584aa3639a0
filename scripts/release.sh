#!/bin/bash
# Makes what a release has, on Debian 12, from a clone, without a network but Debian's packages: .deb files, a tarball that runs as
# unpacked, a Python wheel, a Dockerfile, SHA-256 sums and a bill of materials (SPDX); with podman or buildah and an image of Debian
# the image, too.
#   scripts/release.sh [--build FOLDER] [--output FOLDER] [--try [--roots FOLDER]]
#     --build     a release build that exists, with the programs and the Python package; default: build/release, built first
#     --output    where the artefacts go, emptied first; default: build/dist
#     --try       then tries them on bare machines: scripts/try_release.sh, as root
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
usage() { sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }
given=
dist=$root/build/dist
try=false
roots=()
while [[ $# -gt 0 ]]; do
  case $1 in
    --build) given=$(realpath "${2:?}"); shift 2 ;;
    --output) dist=$(realpath -m "${2:?}"); shift 2 ;;
    --try) try=true; shift ;;
    --roots) roots=(--roots "${2:?}"); shift 2 ;;
    *) usage ;;
  esac
done
release=$root/scripts/release

if [[ -n $given ]]; then
  "$root/scripts/install_packages.sh" packaging release
  build=$given
else
  build_release "program options python packaging release" corank cuik cuikequations cuikplot3d cuikatan2 corank_manual corank_python
fi
if [[ -e $dist && -n $(ls -A "$dist") && ! -e $dist/SHA256SUMS ]]; then
  echo "$dist holds something else than a release; give another folder by --output" >&2
  exit 1
fi
rm -rf "$dist"
mkdir -p "$dist"

echo "== Do its programs run on every x86-64 processor?"
python3 -B "$release/processor.py" "$build/app/corank" "$build"/python/corank/_corank.*.so
echo "== The Debian packages"
"$root/scripts/debian_packages.sh" --build "$build"
cp "$build"/*.deb "$dist/"
echo "== The wheel, the tarball and the package with all libraries"
python3 -B "$release/artefacts.py" "$build" "$dist"
python3 -B "$release/sbom.py" "$build" "$dist"
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
sed "s/@VERSION@/$version/" "$release/Dockerfile" >"$dist/Dockerfile"
(cd "$dist" && sha256sum -- * >SHA256SUMS.new && mv SHA256SUMS.new SHA256SUMS)

# CORANK_IMAGE_BASE: the image of Debian to start from, where the registry is out of reach.
for engine in podman buildah; do
  if command -v "$engine" >/dev/null; then
    echo "== The image, by $engine"
    "$engine" build --build-arg "BASE=${CORANK_IMAGE_BASE:-docker.io/library/debian:bookworm-slim}" -t "corank:$version" "$dist"
    break
  fi
done
echo "== The release is in $dist"
(cd "$dist" && ls -l | tail -n +2)
if $try; then
  exec "$root/scripts/try_release.sh" "${roots[@]}" "$dist"
fi
