#!/usr/bin/env bash
# Install what peenflow needs: Debian packages where they are missing, and a virtual environment.
# usage: .ci/setup.sh VENV
set -euo pipefail
venv=$1

fail() {
  echo "setup: $*" >&2
  exit 2
}

# A shim (pyenv's, say) can be on the path for a version that is not installed: ask each what it really is.
find_python() {
  local candidate
  for candidate in python3.13 python3.12 python3.11 python3 /usr/bin/python3; do
    if "$candidate" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2])' 2>/dev/null; then
      command -v "$candidate"
      return
    fi
  done
  fail "Python 3.11 or newer is needed and none was found: install it (Debian: apt-get install python3 python3-venv)."
}

# gmsh and VTK load these libraries even where nothing is drawn on a screen.
libraries=(libGLU.so.1:libglu1-mesa libGL.so.1:libgl1 libEGL.so.1:libegl1 libXcursor.so.1:libxcursor1
  libXft.so.2:libxft2 libXinerama.so.1:libxinerama1 libgomp.so.1:libgomp1)

missing_packages() {
  local known entry
  known=$(PATH=$PATH:/sbin:/usr/sbin ldconfig -p 2>/dev/null || true)
  command -v liggghts >/dev/null || echo liggghts
  command -v ccx >/dev/null || echo calculix-ccx # tests run what `peenflow export --to calculix` writes
  for entry in "${libraries[@]}"; do
    grep -q "${entry%%:*}" <<<"$known" || echo "${entry##*:}"
  done
  # Debian ships Python without what makes environments
  "$python" -c 'import venv, ensurepip' 2>/dev/null || echo "$venv_package"
}

python=$(find_python)
venv_package=$("$python" -c 'import sys; print("python3.%d-venv" % sys.version_info[1])')
mapfile -t missing < <(missing_packages)

if ((${#missing[@]})); then
  command -v apt-get >/dev/null ||
    fail "these are missing, and there is no apt-get here to install them: ${missing[*]} (Debian's names). Install them, then run make again."
  as_root=()
  if ((EUID != 0)); then
    sudo -n true 2>/dev/null ||
      fail "these are missing and need root: run 'apt-get install ${missing[*]}' as root, then make again."
    as_root=(sudo -n)
  fi
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi

[ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -e '.[dev]'
