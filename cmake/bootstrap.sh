# Shell functions shared by ./stormproof, tests/run and .ci/run: install what is missing, configure,
# build. The caller sets `root`, the project's folder. Nothing here writes to stdout, which belongs
# to the program.
#
# Lists of packages are split into words on purpose; `root` comes from the caller.
# shellcheck shell=sh disable=SC2046,SC2154

# Megabytes of memory that are free: of the machine, or of the control group if it grants less.
free_megabytes() {
  {
    sed -n 's/^MemAvailable: *\([0-9]*\) kB$/\1/p' /proc/meminfo 2>/dev/null
    for limit in /sys/fs/cgroup/memory.max /sys/fs/cgroup/memory/memory.limit_in_bytes; do
      sed -n 's/^\([0-9]\{7,18\}\)$/\1/p' "$limit" 2>/dev/null
    done | awk '{ print int($1 / 1024) }'
  } | sort -n | head -n 1 | awk '{ print int($1 / 1024) }'
}

# As many at once as there are cores, but no more than fit: one compilation takes up to 1.2 GB.
fitting_jobs() {
  cores=$(nproc 2>/dev/null || echo 2) free=$(free_megabytes)
  fit=$((${free:-0} / 1200))
  [ -n "$free" ] && [ "$fit" -lt "$cores" ] || fit=$cores
  [ "$fit" -ge 1 ] || fit=1
  echo "$fit"
}
jobs=${STORMPROOF_JOBS:-$(fitting_jobs)}

say() { printf 'stormproof: %s\n' "$*" >&2; }
have() { command -v "$1" >/dev/null 2>&1; }
installed() { dpkg-query -W -f '${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

# list <group>... : the lines of debian-packages.txt that belong to the groups
list() {
  for group in "$@"; do
    sed -n "s/^$group  *//p" "$root/cmake/debian-packages.txt"
  done
}

# missing_packages <group>... : one line of alternatives for each package that is not there
missing_packages() {
  list "$@" | while read -r command alternatives; do
    [ "$command" = - ] || ! have "$command" || continue
    for package in $(echo "$alternatives" | tr '|' ' '); do
      if installed "$package" || [ -d "$root/.deps/$package" ]; then continue 2; fi
    done
    echo "$alternatives"
  done
}

# choose <alternatives>... : of each set of alternatives the first package the system offers
choose() {
  for alternatives in "$@"; do
    chosen=${alternatives%%|*}
    for package in $(echo "$alternatives" | tr '|' ' '); do
      if apt-cache show "$package" >/dev/null 2>&1; then chosen=$package && break; fi
    done
    echo "$chosen"
  done
}

# unpack <package>... : makes packages of headers usable without installing them, below .deps/
unpack() (
  mkdir -p "$root/.deps"
  cd "$root/.deps" || exit 1
  for package in "$@"; do
    say "unpacking $package into .deps; it cannot be installed next to libboost1.74-dev"
    apt-get -qq download "$package" >&2 || exit 1
    dpkg-deb -x "$package"_*.deb "$package" || exit 1
    rm -f "$package"_*.deb
  done
)

# without_boost / only_boost <package>... : split a list
without_boost() { printf '%s\n' "$@" | grep -v '^libboost'; }
only_boost() { printf '%s\n' "$@" | grep '^libboost'; }

# install_missing <group>... : returns 1 if nothing was missing, exits with 2 if it cannot install
install_missing() {
  if ! have apt-get || ! have dpkg-query; then
    say "not a Debian or Ubuntu system. Install a C++20 compiler, cmake 3.25 or newer, ninja or" \
      "make, and the libraries behind these Debian packages:" \
      "$(list "$@" | sed 's/^[^ ]* *//; s/|.*//' | tr '\n' ' ')"
    return 1
  fi
  set -- $(missing_packages "$@")
  [ $# -gt 0 ] || return 1

  admin=yes sudo=
  if [ "$(id -u)" -ne 0 ]; then
    sudo=sudo
    if ! have sudo || { [ ! -t 2 ] && ! sudo -n true 2>/dev/null; }; then admin=no; fi
  fi
  if [ $admin = yes ]; then
    $sudo apt-get -qq update >&2 </dev/null ||
      say "apt-get update failed; trying with the lists at hand"
  fi
  set -- $(choose "$@")
  # Debian's Boost packages exclude one another, and another program may need the older one.
  if installed libboost1.74-dev && [ -n "$(only_boost "$@")" ] && unpack $(only_boost "$@"); then
    set -- $(without_boost "$@")
    [ $# -gt 0 ] || return 0
  fi
  if [ $admin = no ]; then
    say "packages are missing; as administrator: apt-get update && apt-get install -y $*"
    exit 2
  fi
  say "installing $*"
  if ! $sudo env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 \
    install -y --no-remove --no-install-recommends "$@" >&2 </dev/null; then
    say "could not install; try as administrator: apt-get update && apt-get install $*"
    exit 2
  fi
}

# configure <preset> <folder> <options>... : the log is shown by the caller, if it is of interest.
# STORMPROOF_WERROR=ON makes warnings errors.
configure() (
  preset=$1 folder=$2
  shift 2
  [ -z "${STORMPROOF_WERROR:-}" ] || set -- "$@" "-DSTORMPROOF_WERROR=$STORMPROOF_WERROR"
  cd "$root" || exit 1
  for unpacked in "$root"/.deps/*/usr; do
    [ -d "$unpacked" ] || continue
    export CMAKE_PREFIX_PATH="$unpacked${CMAKE_PREFIX_PATH:+:$CMAKE_PREFIX_PATH}"
  done
  if have ninja && [ -z "${CMAKE_GENERATOR:-}" ]; then export CMAKE_GENERATOR=Ninja; fi
  cmake --preset "$preset" --fresh "$@" >"$root/$folder/configure.log" 2>&1 </dev/null
)

# configured <folder> <line>... : whether the folder holds a complete build system of this very tree,
# with these lines in its cache, made after the list of packages changed for the last time, and no
# configuration that failed has left its cache behind since
configured() {
  folder=$1
  shift
  for line in "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$@"; do
    grep -qxF "$line" "$root/$folder/CMakeCache.txt" 2>/dev/null || return 1
  done
  set -- "$folder"
  for made in "$root/$1/build.ninja" "$root/$1/Makefile"; do
    [ -z "$(find "$made" -newer "$root/$1/CMakeCache.txt" 2>/dev/null)" ] || break
    made=
  done
  [ -n "$made" ] &&
    [ -z "$(find "$root/cmake/debian-packages.txt" -newer "$root/$1/configure.log" 2>/dev/null)" ]
}

# build <folder> <targets> : says nothing when everything is up to date
build() {
  build_status=$root/$1/build.status
  {
    status=0
    # shellcheck disable=SC2086  # the targets are words
    cmake --build "$root/$1" --target $2 -j "$jobs" 2>&1 </dev/null || status=$?
    echo "$status" >"$build_status"
  } | tee "$root/$1/build.log" | sed -e '/^ninja: no work to do\.$/d' -e '/Re-checking globbed directories/d' \
    -e '/^ninja: Entering directory/d' -e '/Built target /d' -e '/^Consolidate compiler/d' >&2
  [ "$(cat "$build_status")" -eq 0 ]
}

# outdated <folder> : whether the last build failed because of its configuration, not of a source: a
# library has moved, or CMake itself fails now
outdated() {
  grep -qE 'no known rule to make it|No rule to make target|FAILED: build\.ninja' "$root/$1/build.log"
}

# prepare <preset> <folder> <groups> <options>... : configures, and installs what is missing for it;
# exits if that fails
prepare() {
  preset=$1 into=$2 groups=$3
  shift 3
  # Try first: the libraries may be there without their packages. Install only if that fails.
  if have cmake && configure "$preset" "$into" "$@"; then return 0; fi
  # shellcheck disable=SC2086  # the groups are words
  if install_missing $groups && configure "$preset" "$into" "$@"; then return 0; fi
  [ ! -s "$root/$into/configure.log" ] || cat "$root/$into/configure.log" >&2
  say "cannot configure the build"
  exit 2
}

# bootstrap <preset> <folder> <targets> <package groups> [with_tests] : the whole way to an up-to-date
# build; exits if it fails
bootstrap() {
  tests_option= tests_line=
  if [ "${5:-}" = with_tests ]; then
    tests_option=-DSTORMPROOF_BUILD_TESTS=ON
    tests_line=STORMPROOF_BUILD_TESTS:BOOL=ON
  fi
  # A read-only copy that was built before is used as it is.
  if [ -f "$root/$2/CMakeCache.txt" ] && [ ! -w "$root/$2" ]; then return 0; fi
  mkdir -p "$root/$2" || exit 2
  # One build at a time in one folder. The lock ends with descriptor 9, and no later than this
  # process.
  exec 9>"$root/$2/.lock"
  if have flock && ! flock -n 9; then
    say "waiting for another build in $2, or for tests that use it"
    flock 9
  fi

  prepared=
  if ! configured "$2" ${tests_line:+"$tests_line"}; then
    say "preparing $2 (once)"
    prepare "$1" "$2" "$4" $tests_option
    prepared=yes
  fi
  if ! build "$2" "$3" && ! {
    [ -z "$prepared" ] && outdated "$2" && say "preparing $2 anew" &&
      prepare "$1" "$2" "$4" $tests_option && build "$2" "$3"
  }; then
    say "the build in $2 failed"
    exit 70
  fi
  exec 9>&-
}
