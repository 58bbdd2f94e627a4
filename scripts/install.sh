#!/bin/sh
# Installs the command chamfer for Linux (x86-64) and macOS: takes the newest release and puts the program
# into ~/.local/bin, or where CHAMFER_BIN says. It asks for no rights and changes nothing else.
set -eu

address=${CHAMFER_ADDRESS:-@ADDRESS@}
bin=${CHAMFER_BIN:-$HOME/.local/bin}

fail() {
    printf 'chamfer was not installed: %s\n' "$1" >&2
    exit 1
}

case "$(uname -s) $(uname -m)" in
    "Linux x86_64") platform=linux ;;
    Darwin\ *) platform=macos ;;
    *) fail "there is no build for $(uname -sm); with Rust, build it yourself: cargo install --git $address --locked chamfer-cli" ;;
esac
for tool in curl tar; do
    command -v "$tool" > /dev/null || fail "it needs $tool"
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
archive=$address/releases/latest/download/chamfer-$platform.tar.gz
curl --fail --silent --show-error --location --output "$folder/chamfer.tar.gz" "$archive" ||
    fail "$archive cannot be had"
tar -C "$folder" -xzf "$folder/chamfer.tar.gz"
mkdir -p "$bin"
# The licences go along with what they are of.
mkdir -p "$bin/../share/doc/chamfer"
for text in LICENSE-MIT LICENSE-APACHE THIRD-PARTY.md; do
    cp "$folder/$text" "$bin/../share/doc/chamfer"
done
mv -f "$folder/chamfer" "$bin/chamfer"
printf 'installed %s\n' "$bin/chamfer"
case ":$PATH:" in
    *":$bin:"*) printf 'try: chamfer demo\n' ;;
    *) printf '%s is not on the PATH; try: %s/chamfer demo\n' "$bin" "$bin" ;;
esac
