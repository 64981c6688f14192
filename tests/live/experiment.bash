# One discovery: starts captures and participants, waits until everybody knows everybody, stops, and
# has the captures summarised, compared with the model and judged. Sourced by tests/live/run.
#
# shellcheck shell=bash disable=SC2154

# wait_for <what> <seconds> <command>... : until the command succeeds
wait_for() {
  local what=$1 polls=$(($2 * 20))
  while ! "${@:3}"; do
    ((polls-- > 0)) || fail "$what did not happen within $2 s"
    sleep 0.05 || true
  done
}

start_capture() { # <host> <folder> : what the host sends, whole packets
  # Not through a function: the process of a function is a shell, which would get the signals.
  ip netns exec "$(namespace "$1")" dumpcap -q -P -s 0 -B 128 -i "$interface" \
    -f "src host $(address "$1")" -w "$2/host-$1.pcap" \
    >/dev/null 2>"$2/capture-$1.log" </dev/null &
  capture_pids[$1]=$!
  wait_for "the capture on host $1" 20 grep -qs '^File: ' "$2/capture-$1.log"
}

start_doctor() { # <folder> : on host 0, where it hears all
  [[ -n $doctor ]] || return 0
  ip netns exec "$(namespace 0)" "$program" doctor --interface "$interface" --for "$doctor" \
    --recording "$1/doctor.pcap" --no-advice --no-progress --report "json=$1/doctor.json" \
    >"$1/doctor.txt" 2>"$1/doctor.log" </dev/null &
  doctor_pid=$!
  wait_for "the recording of doctor" 20 test -s "$1/doctor.pcap"
}

# judge_doctor <folder>... : what it said while it happened, and what it says of the captures
judge_doctor() {
  local folder live after captures=()
  for folder in "$@"; do
    live=$(sed -n 's/^  "storm": \(true\|false\),$/\1/p' "$folder/doctor.json")
    captures_in "$folder"
    "$program" doctor "${captures[@]}" --no-advice --no-progress \
      --format json >"$folder/doctor-after.json" 2>/dev/null || true
    after=$(sed -n 's/^  "storm": \(true\|false\),$/\1/p' "$folder/doctor-after.json")
    if [[ -z $live || $live != "$after" ]] || ! grep -q '"vendor": "Fast DDS"' "$folder/doctor.json" ||
      ! grep -q "^  \"participant_count\": $((hosts * np)),\$" "$folder/doctor.json"; then
      say "doctor, live: storm ${live:-unknown}; of the captures: ${after:-unknown}"
      cat "$folder/doctor.log" >&2
      return 1
    fi
    say "doctor, live and of the captures: storm $live"
  done
}

start_server() { # <folder> : on host 0, there before everybody else
  ip netns exec "$(namespace 0)" env -u FASTRTPS_DEFAULT_PROFILES_FILE -C "$1" "$participant" \
    --serves 1 --discovery "$discovery" --server "$(address 0)" --host 0 --hosts "$hosts" --index 0 \
    --np "$np" --ne 0 --address "$(address 0)" --start "$1/start" \
    --report "$1/server" >"$1/server.log" 2>&1 </dev/null &
  participant_pids+=("$!")
  wait_for "the start of the server" 20 test -e "$1/server.ready"
  rm "$1/server.ready"
}

start_participants() { # <folder>
  local host index log=$1/participants.log all
  all=$(for ((host = 0; host < hosts; ++host)); do address "$host"; done | paste -sd,)
  # No profiles but the bed's: neither of the environment nor of the folder it is started in.
  mkdir "$1/participants"
  participant_pids=()
  [[ $discovery != server && $discovery != super_client ]] || start_server "$1"
  for ((host = 0; host < hosts; ++host)); do
    for ((index = 0; index < np; ++index)); do
      ip netns exec "$(namespace "$host")" env -u FASTRTPS_DEFAULT_PROFILES_FILE \
        -u CYCLONEDDS_URI -C "$1/participants" "$participant" --host "$host" --hosts "$hosts" --index "$index" --np "$np" \
        --ne "$ne" --address "$(address "$host")" --addresses "$all" \
        --send-buffer "$send_buffer" --create-over-us $((create_over_ns / 1000)) \
        --simultaneous "$simultaneous" --start "$1/start-$host-$index" \
        --discovery "$discovery" --server "$(address 0)" --multicast "$cyclone_multicast" \
        --report "$1/participants/$host-$index.json" >>"$log" 2>&1 </dev/null &
      participant_pids+=("$!")
    done
  done
  wait_for "the start of $((hosts * np)) participants" 60 \
    count_is $((hosts * np)) "$1/participants" '*.ready'
  rm "$1/participants/"*.ready
}

count_is() { # <number> <folder> <pattern>
  [[ $(find "$2" -name "$3" | wc -l) -eq $1 ]]
}

now_ns() { date +%s%N; }

# release <folder> : the first participants start at the instant start_ns, the others by the spread later
release() {
  local host index place
  start_ns=$(($(now_ns) + 300000000))
  for ((host = 0; host < hosts; ++host)); do
    for ((index = 0; index < np; ++index)); do
      place=$((host * np + index))
      [[ $by == process ]] || place=$host
      echo $((start_ns + place * start_spread_ns)) >"$1/start.part"
      mv "$1/start.part" "$1/start-$host-$index"
    done
  done
}

# wait_for_completion <folder> : or for the limit, or an interrupt
wait_for_completion() {
  local deadline=$((start_ns + limit_ns))
  until count_is $((hosts * np)) "$1/participants" '*.json'; do
    [[ -z $interrupted && $(now_ns) -lt $deadline ]] || break
    sleep 0.05 || true
  done
  waited_ns=$(($(now_ns) - start_ns))
}

# end <pid>... : asks, waits two seconds, insists
end() {
  local pid polls=40
  kill -TERM "$@" 2>/dev/null || true
  for pid in "$@"; do
    while kill -0 "$pid" 2>/dev/null && ((polls-- > 0)); do sleep 0.05 || true; done
    kill -KILL "$pid" 2>/dev/null || true
    wait "$pid" 2>/dev/null || true
  done
}

stop_all() { # <folder>
  # What is still in the buffer of the captures reaches them within a quarter of a second.
  sleep 0.5 || true
  end "${capture_pids[@]}"
  end "${participant_pids[@]}"
  local host
  tx_dropped=() rx_dropped=()
  for ((host = 0; host < hosts; ++host)); do
    tx_dropped+=("$(transmit_drops "$host")")
    rx_dropped+=("$(socket_drops "$host")")
  done
  rm -f "$1"/start-*
}

# completion_of <folder> : the instant at which the last participant knew everything; the end of
# the wait if one did not, or too late
completion_of() {
  local instants
  instants=$(sed -n 's/.*"\(app\|strict\)_ns": \([0-9]*\).*/\2/p' "$1/participants/"*.json |
    sort -n)
  if [[ $(wc -l <<<"$instants") -eq $((2 * hosts * np)) && $(head -n 1 <<<"$instants") != 0 &&
    $(tail -n 1 <<<"$instants") -le $((start_ns + limit_ns)) ]]; then
    tail -n 1 <<<"$instants"
  else
    echo $((start_ns + waited_ns))
  fi
}

# capture_line <host> <folder> : packets, and those that the capture lost, as JSON
capture_line() {
  local numbers
  numbers=$(sed -n "s|.*received/dropped on interface.*: \([0-9]*\)/\([0-9]*\) .*|\1 \2|p" \
    "$2/capture-$1.log")
  # Without this line nothing is known: as bad as lost packets.
  printf '{"packets": %s, "dropped": %s, "interface_dropped": %s, "socket_dropped": %s}' \
    "${numbers%% *}" "${numbers##* }" "${tx_dropped[$1]}" "${rx_dropped[$1]}"
}

write_record() { # <folder> <completion>
  local host lines=''
  for ((host = 0; host < hosts; ++host)); do
    lines+="    $(capture_line "$host" "$1")$( ((host + 1 == hosts)) || echo ,)"$'\n'
  done
  cat >"$1/run.json" <<END
{
  "link": "$link",
  "discovery": "$discovery",
  "sedp_multicast": $([[ $cyclone_multicast == 1 ]] && echo true || echo false),
  "start_spread_ns": $start_spread_ns,
  "start_by": "$by",
  "participants_per_host": $np,
  "endpoints_per_participant": $ne,
  "simultaneous": $([[ $simultaneous == 1 ]] && echo true || echo false),
  "create_over_ns": $create_over_ns,
  "send_buffer_bytes": $send_buffer,
  "access_point_options": "${access_point_options[*]}",
  "start_ns": $start_ns,
  "limit_ns": $limit_ns,
  "waited_ns": $waited_ns,
  "until_ns": $2,
  "captures": [
${lines%$'\n'}
  ]
}
END
}

summarise() { # <folder> <instant>
  local captures=() status=0
  captures_in "$1"
  "$program" capture summarize "${captures[@]}" --until "$2" >"$1/summary.txt" || status=$?
  "$program" capture summarize "${captures[@]}" --until "$2" --format json >"$1/summary.json" ||
    status=$?
  # 3: required keys are missing. The judgement says so.
  [[ $status -eq 0 || $status -eq 3 ]] || fail "the captures cannot be summarised"
}

# run_once <folder> : leaves there all that stormproof_live_report reads
run_once() {
  local folder=$1 completion host
  add_network "$folder"
  for ((host = 0; host < hosts; ++host)); do start_capture "$host" "$folder"; done
  start_participants "$folder"
  start_doctor "$folder"
  release "$folder"
  wait_for_completion "$folder"
  [[ -z $doctor ]] || wait "$doctor_pid" || true
  stop_all "$folder"
  remove_network
  completion=$(completion_of "$folder")
  write_record "$folder" "$completion"
  summarise "$folder" "$completion"
  explain "$folder" "$completion"
  compare "$folder" "$completion"
}
