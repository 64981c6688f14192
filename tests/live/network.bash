# Hosts on one machine: network namespaces that are joined by a veth pair or by the user-space
# access point, with names that hold the process id of the run, so that runs do not meet and what a
# killed run left behind is recognised. Sourced by tests/live/run, which sets `run_id`, `hosts`, `link` and
# `access_point`, and calls remove_network whatever happens.
#
# shellcheck shell=bash disable=SC2154

readonly name_prefix=stormproof-live
# Of the interface inside a namespace.
readonly interface=lan0
readonly mtu=1500

address() { echo "10.77.0.$(($1 + 1))"; }
hardware_address() { printf '02:00:0a:4d:00:%02x' $(($1 + 1)); }
# namespace <host> : its name
namespace() { echo "$name_prefix-$run_id-$1"; }
# device <host> : the name of the interface before it is in its namespace; at most 15 characters
device() { echo "spl$run_id$1"; }
inside() { ip netns exec "$(namespace "$1")" "${@:2}"; }

add_namespaces() {
  local host problem
  for ((host = 0; host < hosts; ++host)); do
    problem=$(ip netns add "$(namespace "$host")" 2>&1) ||
      skip "cannot create a network namespace: $problem"
    # Neighbour discovery of IPv6 would use the channel. Where there is none to turn off: fine.
    inside "$host" tee /proc/sys/net/ipv6/conf/{all,default}/disable_ipv6 <<<1 >/dev/null 2>&1 ||
      true
    ip -n "$(namespace "$host")" link set dev lo up
  done
}

add_veth_pair() {
  local problem
  problem=$(ip link add "$(device 0)" type veth peer name "$(device 1)" 2>&1) ||
    skip "cannot create a veth pair: $problem"
}

# start_access_point <folder> : returns when all TAP devices exist
start_access_point() {
  local log=$1/access-point.log waited=0 host taps=()
  for ((host = 0; host < hosts; ++host)); do taps+=(--tap "$(device "$host")"); done
  [[ -c /dev/net/tun ]] || skip "/dev/net/tun is not there: the kernel has no TAP devices"
  # It has to wake up in time among all the participants that discover each other.
  nice -n -15 "$access_point" "${taps[@]}" \
    --statistics "$1/access-point.json" "${access_point_options[@]}" >"$log" 2>&1 </dev/null &
  access_point_pid=$!
  until grep -qs '^ready' "$log"; do
    if ! kill -0 "$access_point_pid" 2>/dev/null || ((++waited > 200)); then
      cat "$log" >&2
      say "the access point did not start"
      exit 2
    fi
    sleep 0.05
  done
}

# shape <namespace> : packets wait in front of the link, on the account of their sockets
shape() {
  local problem
  problem=$(ip netns exec "$1" tc qdisc add dev "$interface" root \
    tbf rate "$rate" burst 3028 limit 1000000000 2>&1) || skip "cannot limit the rate: $problem"
}

# configure_host <host> : moves its end of the link into its namespace and gives it addresses
configure_host() {
  local host=$1 space peer
  space=$(namespace "$host")
  ip link set dev "$(device "$host")" netns "$space"
  ip -n "$space" link set dev "$(device "$host")" name "$interface"
  ip -n "$space" link set dev "$interface" mtu "$mtu" txqueuelen 10000 \
    address "$(hardware_address "$host")"
  # A veth pair passes on packets without checksums; captures shall have them.
  if [[ $link == veth ]]; then
    inside "$host" ethtool --offload "$interface" tx off rx off gso off tso off gro off \
      >/dev/null 2>&1 || say "note: cannot turn off checksum offload"
  fi
  [[ -z ${rate:-} ]] || shape "$space"
  ip -n "$space" address add "$(address "$host")/24" dev "$interface"
  ip -n "$space" link set dev "$interface" up
  ip -n "$space" route add 224.0.0.0/4 dev "$interface"
  # No ARP on the channel either.
  for ((peer = 0; peer < hosts; ++peer)); do
    [[ $peer -eq $host ]] || ip -n "$space" neighbour replace "$(address "$peer")" \
      lladdr "$(hardware_address "$peer")" dev "$interface" nud permanent
  done
}

# add_network <folder> : the whole network; the access point reports into the folder
add_network() {
  add_namespaces
  if [[ $link == veth ]]; then add_veth_pair; else start_access_point "$1"; fi
  local host
  for ((host = 0; host < hosts; ++host)); do configure_host "$host"; done
}

# transmit_drops <host> : packets that the host's interface dropped before they were on the link
transmit_drops() { inside "$1" cat "/sys/class/net/$interface/statistics/tx_dropped"; }

# socket_drops <host> : datagrams that arrived and found the buffer of their socket full
socket_drops() {
  local drops
  # In, no port, in errors, out, receive buffer errors, ...
  read -r _ _ _ _ _ drops _ < <(inside "$1" sed -n '/^Udp: [0-9]/p' /proc/net/snmp)
  echo "$drops"
}

# remove_namespace <name> : with the processes in it; its interfaces go with it
remove_namespace() {
  local pid
  for pid in $(ip netns pids "$1" 2>/dev/null); do kill -KILL "$pid" 2>/dev/null || true; done
  ip netns delete "$1"
}

# remove_network : also one that is half there
remove_network() {
  local host
  if [[ -n ${access_point_pid:-} ]]; then
    # Its statistics are written when it ends.
    kill -TERM "$access_point_pid" 2>/dev/null || true
    wait "$access_point_pid" 2>/dev/null || true
    access_point_pid=
  fi
  for ((host = 0; host < hosts; ++host)); do
    ! ip link show dev "$(device "$host")" >/dev/null 2>&1 ||
      ip link delete dev "$(device "$host")" 2>/dev/null || true
    [[ ! -e /run/netns/$(namespace "$host") ]] || remove_namespace "$(namespace "$host")"
  done
}

# is_running <process id> : whether it is a run of this bed
is_running() {
  # A shell keeps the script that it runs open.
  readlink "/proc/$1/fd/255" 2>/dev/null | grep -q '/tests/live/run$'
}

# leftovers : namespaces and temporary folders of runs that are gone, one per line
leftovers() {
  local name pid
  {
    ip netns list | sed -n "s/^\($name_prefix-[0-9]*-[0-9]\)\( .*\)\?$/\1/p"
    find "${TMPDIR:-/tmp}" -maxdepth 1 -type d -name "$name_prefix-[0-9]*.??????"
  } | while read -r name; do
    pid=${name##*"$name_prefix-"}
    is_running "${pid%%[!0-9]*}" || echo "$name"
  done
}

# clean : removes them; an access point ends when its devices are gone
clean() {
  local name count=0
  while read -r name; do
    if [[ $name == /* ]]; then rm -rf "$name"; else remove_namespace "$name"; fi
    count=$((count + 1))
  done < <(leftovers)
  say "$count namespaces and folders of earlier runs removed"
}
