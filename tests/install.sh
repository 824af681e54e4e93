# To be sourced: `need COMMAND PACKAGE [COMMAND PACKAGE ...]` installs Debian's packages of the commands that are absent;
# `browser FOLDER` gets playwright-core from npm into FOLDER, beside Chromium and Node.js.
need() {
    local absent=() sudo
    while [ $# -gt 0 ]; do
        command -v "$1" >/dev/null || absent+=("$2")
        shift 2
    done
    [ ${#absent[@]} -eq 0 ] && return
    sudo=$([ "$(id -u)" -eq 0 ] || echo sudo)
    $sudo apt-get update -qq
    $sudo apt-get install -y -qq "${absent[@]}" >/dev/null
}

browser() {
    need chromium chromium node nodejs npm npm
    cp "$(dirname "${BASH_SOURCE[0]}")/studio/package.json" "$1"
    (cd "$1" && npm install --silent --no-audit --no-fund)
}
