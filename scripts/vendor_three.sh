#!/bin/bash
# Makes third_party/three/three.bundle.min.js anew: the parts of three.js that entry.mjs names, bundled. Needs npm.
set -euo pipefail
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../third_party/three" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$folder/entry.mjs" "$work"
cd "$work"
npm install --silent --no-save three@0.187.0 esbuild@0.28.2
npx esbuild entry.mjs --bundle --minify --format=iife --global-name=THREE --legal-comments=inline \
    --outfile="$folder/three.bundle.min.js"
cp node_modules/three/LICENSE "$folder/LICENSE"
