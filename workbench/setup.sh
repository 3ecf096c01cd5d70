# Sourced by workbench/run and tests/run: installs missing packages, configures and builds.
# Expects `root` (the project's folder) and `self` (the name that starts each line) to be set.
# Lines go to standard error, so that the program's own output stays clean in a pipe.

launch=()  # a command before ninja, such as setarch with its options

say() { printf '%s: %s\n' "$self" "$*" >&2; }
die() { say "$*"; exit 1; }

# Names in package lists, comments removed.
listed_packages() { sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "$@"; }

# Those of the listed packages that are not installed.
missing_packages() {
  local -A installed=()
  local name status
  while read -r status name; do
    [[ $status == installed ]] && installed[$name]=1
  done < <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $(listed_packages "$@") 2>/dev/null)
  for name in $(listed_packages "$@"); do
    [[ ${installed[$name]:-} ]] || printf '%s\n' "$name"
  done
}

# install_packages LIST...: asks nothing, touches nothing that is there. Sets `installed_something`.
install_packages() {
  installed_something=0
  if ! command -v dpkg-query >/dev/null; then
    say "this is not Debian, so packages are left to you; needed: $(listed_packages "$@" | xargs)"
    return
  fi
  local missing=() as_root=() log
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    as_root=(sudo -n)
    if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
      say "packages are missing, and installing them needs root or sudo without a password"
      die "run this once, then start again: apt-get install --no-install-recommends ${missing[*]}"
    fi
  fi
  mkdir -p "$root/build"
  log="$root/build/packages.log"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 -q -y)
  say "reading the package lists"
  # A failing mirror among several is no reason to stop: what counts is whether the install succeeds.
  "${apt[@]}" update </dev/null >"$log" 2>&1 || true
  say "installing ${#missing[@]} packages: ${missing[*]}"
  if ! "${apt[@]}" install --no-install-recommends "${missing[@]}" </dev/null >>"$log" 2>&1; then
    tail -n 20 "$log" >&2
    die "installing packages failed; the whole log: $log"
  fi
  installed_something=1
}

# run_logged LOG WHAT COMMAND...: silent unless it fails or takes long enough for a person to wonder.
run_logged() {
  local log="$1" what="$2" status=0 teller
  shift 2
  { sleep 0.4 >/dev/null 2>&1 9>&-; say "$what"; } 9>&- &
  teller=$!
  "$@" </dev/null >"$log" 2>&1 || status=$?
  kill "$teller" 2>/dev/null || true
  wait "$teller" 2>/dev/null || true
  ((status == 0)) && return
  # Compilers print the cause before a long tail of notes: show the first errors, then the end.
  grep -n -m 10 -E 'error:|Error|FAILED' "$log" >&2 || true
  tail -n 30 "$log" >&2
  die "$what failed; the whole log: $log"
}

# configure FOLDER CMAKE-OPTION...: when needed, in build/FOLDER.
configure() {
  local dir="$root/build/$1" fresh=()
  shift
  # A tree that was moved or copied has a cache that names the old place.
  if [[ -f $dir/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$dir/CMakeCache.txt"; then
    fresh=(--fresh)
  fi
  local options="$*"
  if [[ ! -f $dir/build.ninja || $installed_something == 1 || ${#fresh[@]} -gt 0 ||
        $options != "$(cat "$dir/.options" 2>/dev/null)" ]]; then
    mkdir -p "$dir"
    run_logged "$dir/configure.log" "configuring $dir" cmake "${fresh[@]}" -G Ninja -S "$root" -B "$dir" "$@"
    printf '%s\n' "$options" >"$dir/.options"
  fi
}

# build FOLDER TARGETS CMAKE-OPTION...: configures when needed, builds when needed, in build/FOLDER. TARGETS: words.
build() {
  local folder="$1" dir="$root/build/$1" targets=()
  read -ra targets <<<"$2"
  shift 2
  mkdir -p "$dir"
  exec 9>"$dir/.lock"
  flock 9  # two starts at once build one after the other
  configure "$folder" "$@"
  run_logged "$dir/build.log" "building $dir" "${launch[@]}" ninja -C "$dir" "${targets[@]}"
  exec 9>&-
}
