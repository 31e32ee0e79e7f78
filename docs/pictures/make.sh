#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the pictures of README.md and docs/ anew: docs/pictures/make.sh, in a built checkout. Needs xvfb and
# librsvg2-bin.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
muro=build/bin/muro out=docs/pictures
export MURO_PLUGIN_PATH=${MURO_PLUGIN_PATH:-build/lib/muro}
sensors=examples/sensors/sensors.yaml urban=examples/urban/urban.yaml

camera() { "$muro" render "$sensors" --at 0.2 --camera scout/camera --shows "$1" --out "$out/$2.png"; }
camera rgb camera
camera depth depth
camera labels labels
"$muro" render examples/models/parade.yaml --set algorithms.pictures=off --camera observer/camera \
  --out "$out/models.png"
"$muro" render "$urban" --set robots.rovers.count=250 --at 8 --from 0.5,-17,3.4 --to 0,-6,0.3 --fov 60 --size 960x540 \
  --out "$out/urban.png"
"$muro" render examples/swarm/swarm.yaml --at 45 --from 0,-15,5.5 --to 3.7,-6,0 --fov 58 --size 960x540 --out "$out/swarm.png"
"$muro" render examples/levels/levels.yaml --at 4 --from -3,-3,2.2 --to 0,0,0 --size 960x540 --out "$out/levels.png"
"$muro" render examples/balancer/balancer.yaml --at 4.5 --from=-10.9,-1.9,0.6 --to=-6.9,-0.15,0.1 --fov 42 \
  --size 800x450 --out "$out/balancer.png"
"$muro" render examples/biped/biped.yaml --at 4.12 --from=1.7,-1.6,0.75 --to=0.75,0.35,0.15 --fov 45 --size 800x450 \
  --out "$out/biped.png"
"$muro" render examples/walk/walk.yaml --at 5 --from=2.1,-1.1,0.65 --to=0.2,0.07,0.14 --fov 48 --size 960x540 \
  --out "$out/walk.png"
"$muro" render examples/quadruped/quadruped.yaml --at 8.15 --from=6.3,-3.9,1.45 --to=3.7,-1.1,0.1 --fov 50 \
  --size 960x540 --out "$out/quadruped.png"
"$muro" render examples/mixed_team/mixed_team.yaml --at 23 --from=-3.3,-10.4,2.2 --to=0.5,-3.5,1.33 --fov 66 \
  --size 1280x720 --out "$out/mixed_team.png"
"$muro" render examples/soccer/soccer.yaml --at 1.45 --from=-1.9,-2.5,1.05 --to=0.75,0.35,0.05 --fov 52 --size 1280x640 \
  --out "$out/soccer.png"
"$muro" render examples/soccer/match.yaml --at 39.58 --from=2.2,0.7,1.5 --to=4.3,-0.3,0.1 --fov 62 --size 1280x720 \
  --out "$out/match.png"

allan=$(mktemp --suffix=.svg)
"$muro" sensors allan examples/sensors/imu_at_rest.yaml --sensor fine --reading angular_velocity --duration 20000 \
  --out "$allan" >/dev/null
rsvg-convert "$allan" -o "$out/allan.png"
rm "$allan"
"$muro" compare examples/sensors/scanner_room.yaml --against examples/sensors/scanner_room.scip \
  --vary stand.laser=raycast,zbuffer --out "$out/scanner_noise.svg" >/dev/null

window() { xvfb-run -a -s "-screen 0 1400x900x24" "$muro" run "$@"; }
scans() {
  local name=$1
  shift
  window "$sensors" --view --speed max --set algorithms.view.panels=false --set algorithms.view.contacts=false \
    --set algorithms.view.samples=4 --set algorithms.view.width=960 --set algorithms.view.height=540 \
    --set 'algorithms.view.from=[-6,-3.6,3.6]' --set 'algorithms.view.to=[1.2,0,0.2]' \
    --set "algorithms.view.picture=$out/$name.png" "$@"
}
scans lidar --duration 0.3 --set robots.scout.sweep=off --set robots.scout.laser_error=off --set robots.scout.control=off \
  --set robots.scout.laser=off
scans scan --duration 3 --set robots.scout.lidar=off
window examples/team/team.yaml --view --speed max --duration 1.5 --set algorithms.view.panels=false \
  --set algorithms.view.contacts=false --set algorithms.view.samples=4 --set algorithms.view.width=1280 \
  --set algorithms.view.height=600 --set 'algorithms.view.from=[-4.2,-3.9,1.6]' \
  --set 'algorithms.view.to=[-0.5,-0.5,0.32]' --set "algorithms.view.picture=$out/team.png"
window examples/offroad/offroad.yaml --view --speed max --duration 28 --set algorithms.view.panels=false \
  --set algorithms.view.contacts=false --set algorithms.view.samples=4 --set algorithms.view.width=1280 \
  --set algorithms.view.height=640 --set 'algorithms.view.from=[-9.5,-14.5,3.6]' \
  --set 'algorithms.view.to=[-2.2,-7.6,0.7]' --set "algorithms.view.picture=$out/offroad.png"
window "$urban" --view --duration 4 --set algorithms.view.follow=rovers_0 --set algorithms.view.samples=4 \
  --set "algorithms.view.picture=$out/window.png"
