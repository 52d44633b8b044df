#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Pins every version, for Python 3.10 to 3.13 on x86_64 Linux. Needs uv (pip install uv).
set -eu
cd "$(dirname "$0")/../.."
command -v uv > /dev/null || {
  echo 'make lock needs uv, which is not installed: pip install uv' >&2
  exit 1
}
platform="sys_platform == 'linux' and platform_machine == 'x86_64' and implementation_name == 'cpython'"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/pyproject.toml" << EOF
[tool.uv]
environments = ["$platform and python_version < '3.14'"]
[[tool.uv.dependency-metadata]]
name = "pyrnnoise"
requires-dist = []
EOF
cp tools/setup/requirements*.in "$folder"

pins() { # of files in the folder, one a line
  (cd "$folder" && uv pip compile --quiet --universal --no-annotate --no-header --python-version 3.10 "$@") \
    > "$folder/pins"
  sed -e "s/ and implementation_name == 'cpython'//; s/ and platform_machine == 'x86_64'//" \
    -e "s/ and sys_platform == 'linux'//; s/ and platform_python_implementation != 'PyPy'//" \
    -e "s/ and python_full_version < '3.14'//; s/ ; python_full_version < '3.14'\( \\\\\)\{0,1\}\$/\\1/" \
    "$folder/pins"
}

parts() { # each with its line in requirements-parts.in, and what it takes beyond requirements.txt
  grep '^# \[' "$folder/requirements-parts.in" | while IFS= read -r header; do
    awk -v header="$header" '/^# \[/ { inside = ($0 == header) } inside' \
      "$folder/requirements-parts.in" > "$folder/part.in"
    printf '\n%s\n' "$header"
    pins part.in --constraint every "$@" > "$folder/part"
    grep -vxFf "$folder/runtime" "$folder/part"
  done
}

pins requirements.in requirements-parts.in "$@" > "$folder/every"
pins requirements.in --constraint every "$@" > "$folder/runtime"
pins requirements-test.in --constraint every "$@" > "$folder/all"
{
  echo '# Made by `make lock` from tools/setup/requirements.in, which says what each is for.'
  cat "$folder/runtime"
} > "$folder/requirements.txt"
{
  echo '# Made by `make lock` from tools/setup/requirements-parts.in, which says what each is for.'
  parts "$@"
} > "$folder/requirements-parts.txt"
{
  echo '# Made by `make lock` from tools/setup/requirements-test.in: what tests need besides.'
  grep -vxFf "$folder/every" "$folder/all"
} > "$folder/requirements-test.txt"
{
  echo '# Made by `make lock` from tools/setup/requirements-cluster.in, which says what each is for.'
  printf '\n%s\n' "$(grep '^# \[' "$folder/requirements-cluster.in")"
  pins requirements-cluster.in --generate-hashes --constraint every --constraint all "$@"
} > "$folder/requirements-cluster.txt"
{
  echo '# Made by `make lock` from tools/setup/requirements-site.in, which says what each is for.'
  pins requirements-site.in --generate-hashes "$@"
} > "$folder/requirements-site.txt"
mv "$folder"/requirements*.txt . # only now: a failure on the way leaves the old pins
