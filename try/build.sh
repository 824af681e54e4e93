#!/usr/bin/env bash
# The studio as one page that a browser opens from disk: try/build.sh [PAGE.html] [DESIGN.toml]. Takes some three minutes. Needs
# cargo, Node.js and a Rust compiler for WebAssembly: that of $RUSTC_WASM where it is set, that of rustup where it has the
# target wasm32-unknown-unknown, else Debian's rustc-web with its sources, unpacked beside the build without installing it.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
page=$(realpath -m "${1:-$here/target/studio.html}")
design=$(realpath "${2:-$here/../designs/huang2017-multi-arc.toml}")
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$here/target}
mkdir -p "$CARGO_TARGET_DIR" "$(dirname "$page")"
target=wasm32-unknown-unknown
# The generators of argmin are seeded; no randomness is asked of the browser.
flags=(--cfg 'getrandom_backend="unsupported"')
std=()
if [ -n "${RUSTC_WASM:-}" ]; then
    export RUSTC=$RUSTC_WASM
elif [ ! -d "$(rustc --print sysroot)/lib/rustlib/$target" ]; then
    debian=$CARGO_TARGET_DIR/debian
    if [ ! -x "$debian/usr/bin/rustc" ]; then
        mkdir -p "$debian" && cd "$debian"
        apt-get download -qq rustc-web libstd-rust-web-{1.96,dev} rust-web-src lld-22 libllvm22 llvm-22-linker-tools libclang-cpp22
        for package in *.deb; do dpkg -x "$package" . && rm "$package"; done
        cd - >/dev/null
    fi
    export RUSTC=$debian/usr/bin/rustc LD_LIBRARY_PATH=$debian/usr/lib/x86_64-linux-gnu:$debian/usr/lib/llvm-22/lib
    # The package has the sources of the standard library, not its build for WebAssembly.
    export RUSTC_BOOTSTRAP=1
    std=(-Zbuild-std=std,panic_abort)
    flags+=("-Clinker=$debian/usr/bin/wasm-ld-22")
fi
CARGO_ENCODED_RUSTFLAGS=$(IFS=$'\x1f'; echo "${flags[*]}") \
    cargo build --release --quiet --manifest-path "$here/Cargo.toml" --target $target "${std[@]}"
node "$here/compose.mjs" "$CARGO_TARGET_DIR/$target/release/sprag_try.wasm" "$design" "$page"
