#!/usr/bin/env bash
# manual.sh PROGRAM FOLDER writes a page of the manual for the program and for each of its commands, from the output of
# --help, and the completion for bash into FOLDER. It needs help2man.
set -euo pipefail
program=$(realpath "$1") folder=$2
tools=$(mktemp -d)
trap 'rm -rf "$tools"' EXIT
mkdir -p "$folder"
version=$("$program" --version | awk 'NR == 1 {print $2}')

# page NAME TITLE COMMAND...
page() {
  printf '#!/bin/sh\nexec %q %s"$@"\n' "$program" "${3:+$3 }" > "$tools/$1"
  chmod +x "$tools/$1"
  help2man --no-info --section 1 --manual Tomales --source "Tomales $version" --version-string "$version" \
    --name "$2" --help-option --help-all --output "$folder/$1.1" "$tools/$1"
}

page tomales "renders RIB scenes with global illumination" ""
"$program" --help | awk '/^Subcommands:/ {on = 1; next} on && /^  [a-z]/ {print $1} /^[A-Z]/ {on = 0}' |
  while read -r command; do
    title=$("$program" "$command" --help | head -n 1)
    page "tomales-$command" "${title%%.*}" "$command"
  done
gzip -9nf "$folder"/*.1
"$program" completion > "$folder/tomales.bash"
