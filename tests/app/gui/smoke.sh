#!/bin/sh
# One session on the real window under Xvfb: xdotool types another force, turns the block and works on every
# scene; each must change the picture. Usage: smoke.sh PALP_STUDIO [FOLDER for the screenshots]
set -eu
studio=$1
folder=${2:-$(mktemp -d)}
mkdir -p "$folder"
home=$(mktemp -d)
xvfb= app=
end() {
  [ -z "$app" ] || kill "$app" 2>/dev/null || true
  [ -z "$xvfb" ] || kill "$xvfb" 2>/dev/null || true
  rm -rf "$home"
}
trap end EXIT
# The server takes a free display itself, and does not start anew when its only client goes.
Xvfb -displayfd 3 -screen 0 1500x900x24 -noreset -fbdir "$home" 3>"$home/display" >/dev/null 2>&1 &
xvfb=$!
chmod 700 "$home"
tries=0
until [ -s "$home/display" ]; do
  tries=$((tries + 1)); [ $tries -lt 100 ] || { echo "Xvfb does not come up" >&2; exit 1; }
  sleep 0.1
done
DISPLAY=:$(cat "$home/display")
export DISPLAY HOME=$home XDG_RUNTIME_DIR=$home QT_QPA_PLATFORM=xcb
"$studio" &
app=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name 'Palp$' | head -1)
xdotool windowmove "$window" 0 0 windowsize --sync "$window" 1500 900

# settled NAME [BEFORE WORDS]: takes a picture when it has stayed the same for a second; first it must become another than
# BEFORE, which a busy machine may take its time for; WORDS say what is wrong if it never does.
settled() {
  last= same=0 tries=0
  while [ $same -lt 3 ]; do
    sleep 0.4
    cp "$home/Xvfb_screen0" "$folder/$1.xwd" # the server keeps its screen in this file
    now=$(cksum < "$folder/$1.xwd")
    tries=$((tries + 1))
    if [ $# -gt 1 ] && [ "$now" = "$(cat "$folder/$2.sum")" ]; then
      [ $tries -lt 75 ] || { echo "$3" >&2; exit 1; }
      continue
    fi
    if [ "$now" = "$last" ]; then same=$((same + 1)); else same=0; fi
    last=$now
    [ $tries -lt 150 ] || { echo "the picture never settles" >&2; exit 1; }
  done
  echo "$last" > "$folder/$1.sum"
}

settled first
# The spin box of Fz: third of the load panel.
xdotool mousemove --window "$window" 351 358 click --repeat 3 --delay 60 1 key ctrl+a type --delay 40 -- '-2'
xdotool key Return Tab # off the field, whose cursor blinks
settled typed first "typing another force left the picture as it was"
xdotool mousemove --window "$window" 900 350 mousedown 1 mousemove_relative --sync 60 20 mousemove_relative --sync 60 20 mouseup 1
settled turned typed "dragging left the block as it was"
xdotool key ctrl+z
settled undone turned "undo left the picture as it was"
xdotool key ctrl+5 # the simulated board, live
sleep 4
xdotool key space # held
settled live undone "the live scene shows nothing"
xdotool key space
sleep 3
xdotool key space
settled later live "the live scene stands still"
scene() { # NUMBER NAME
  xdotool key "ctrl+$1"
  settled "$2" "$last_scene" "ctrl+$1 does not show the scene $2"
  last_scene=$2
}
last_scene=later
scene 1 design
xdotool mousemove --window "$window" 517 661 click 1 # Make and show the mesh
settled mesh design "the Design scene made no mesh"
scene 3 resistance
xdotool mousemove --window "$window" 500 250 click 1
settled cell resistance "a click on the heatmap chose no cell"
scene 4 network
xdotool mousemove --window "$window" 300 178 click 1 # generate samples
sleep 2
xdotool key Escape
settled stopped network "generating and cancelling samples left the picture as it was"
scene 6 reports
xdotool key ctrl+t
settled dark reports "the dark theme left the picture as it was"
scene 2 dark-deformation
kill -0 "$app" || { echo "the program ended by itself" >&2; exit 1; }
echo "smoke: ok"
