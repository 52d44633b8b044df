# SPDX-License-Identifier: Apache-2.0
"""Let the walking humanoid draw a map of the apartment, and find its way by that map.

`tools/in_environment python3 tools/benchmarks/navigation_mapping.py`. A script drives it through
all rooms while slam_toolbox listens; map_saver_cli saves the map. The share of its occupied cells
near something that the scanner can truly see is printed; then the robot begins anew with that map
and goes to places.
"""

from __future__ import annotations

import argparse
import cmath
import math
from pathlib import Path
import subprocess
from tempfile import TemporaryDirectory

from arguments import in_range
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_navigation.testing import NavigatingRobot
from humanoid_simulation.testing.simulators import RobotClient
from navigation_trials import Belief, REACHED_M, report, robot_at_home
import numpy as np
import numpy.typing as npt
from PIL import Image
from scipy.ndimage import distance_transform_edt
import yaml

NEAR_M = 0.1
SEEN_HEIGHTS_M = (0.69, 0.79)
"""The heights that the scanner sweeps as the body sways; it is 0.74 m above the ground."""
ROUND_M = (
    *(1.3 + 0.0j, 1.3 + 2.8j, 1.3 + 0.0j),  # kitchen
    *(4.4 + 0.0j, 4.4 + 2.0j, 4.4 + 0.0j),  # bedroom
    *(2.7 + 0.0j, 2.7 - 1.6j, 4.6 - 1.6j, 4.6 - 4.0j, 4.6 - 1.6j),  # living room
    *(0.3 - 1.7j, -1.5 - 1.5j, -2.3 + 0.6j, -1.5 + 0.0j, 0.0 + 0.0j),  # hall
)
GOALS = ((0.7, 2.6, 1.57), (4.4, 1.8, 1.57), (4.6, -1.6, 0.0), (-2.3, 0.0, 3.14))


def main() -> int:
    """Create a map, evaluate it, and navigate in it; return 1 if any step is insufficient."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--speed', type=in_range(float, 0.05, 0.5), default=0.3, help='in m/s')
    parser.add_argument('--output', type=Path, help='keep the maps in this folder')
    options = parser.parse_args()
    with TemporaryDirectory() as temporary:
        folder = options.output or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        with ros_sandbox() as ros, robot_at_home('slam:=True'):
            drive_round(RobotClient(ros), options.speed)
            _run('nav2_map_server', 'map_saver_cli', '-f', str(folder / 'drawn'))
        _run(
            *('humanoid_simulation', 'scene_map', 'apartment'),
            *('--from-height', str(SEEN_HEIGHTS_M[0]), '--to-height', str(SEEN_HEIGHTS_M[1])),
            *('--output', str(folder / 'true')),
        )
        share = share_near(folder / 'drawn.yaml', folder / 'true.yaml')
        print(f'{100.0 * share:.1f} % of what is occupied is within {NEAR_M} m of the truth')
        with ros_sandbox() as ros, robot_at_home(f'map:={folder / "drawn.yaml"}'):
            bad = go_round(ros)
    return int(share < 0.95 or bad > 0)


def drive_round(robot: RobotClient, speed: float) -> None:
    """
    Drive through all rooms along `ROUND_M`, steered by ground truth in place of a person.

    Parameters
    ----------
    robot
        The simulated robot.
    speed
        The maximum forward velocity in m/s.

    Raises
    ------
    FellError
        The robot fell.

    """
    for point_m in ROUND_M:
        for only_turn in (True, False):
            while not _steer(robot, point_m, speed, only_turn):
                robot.wait(0.1)
    robot.drive()
    robot.wait(2.0)


def _steer(robot: RobotClient, point_m: complex, speed: float, only_turn: bool) -> bool:
    way_m = point_m - robot.pose.position_m
    turn_rad = math.remainder(cmath.phase(way_m) - robot.pose.yaw_rad, math.tau)
    if abs(way_m) < 0.15 or (only_turn and abs(turn_rad) < 0.15):
        return True
    forward = 0.0 if only_turn else speed * max(math.cos(turn_rad), 0.0)
    robot.drive(forward, 0.0, max(-0.5, min(0.5, 1.5 * turn_rad)))
    return False


def share_near(drawn_file: Path, true_file: Path) -> float:
    """
    Compute the fraction of the occupied cells of a map that are near those of another map.

    Parameters
    ----------
    drawn_file, true_file
        The YAML files of the map to evaluate, and of the true map.

    Returns
    -------
    float
        From 0 to 1; near is within `NEAR_M`, and cells beyond the true map are not near.

    """
    (drawn, origin_m, size_m), (true, true_origin_m, true_size_m) = map(
        _occupied, (drawn_file, true_file)
    )
    distance_m = true_size_m * distance_transform_edt(~true)
    middles_m = origin_m + (np.argwhere(drawn) + 0.5) * size_m
    cells = np.floor((middles_m - true_origin_m) / true_size_m).astype(int)
    inside = ((cells >= 0) & (cells < true.shape)).all(axis=1)
    near = distance_m[tuple(cells[inside].T)] <= NEAR_M
    return float(near.sum() / max(len(cells), 1))


def _occupied(file: Path) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.float64], float]:
    """Return the occupied cells [x, y], the origin of the map, and the resolution in m."""
    table = yaml.safe_load(file.read_text(encoding='utf-8'))
    grey = np.asarray(Image.open(file.parent / table['image']))[::-1].T
    return grey < 50, np.array(table['origin'][:2], float), float(table['resolution'])


def go_round(ros: RosSandbox) -> int:
    """
    Navigate to `GOALS` in the created map, and return the number of goals not reached.

    Parameters
    ----------
    ros
        The domain of the robot.

    """
    robot, belief, bad = NavigatingRobot(ros), Belief(ros), 0
    for number, goal in enumerate(GOALS, 1):
        arrival = robot.go(*goal)
        report(number, goal, arrival)
        off_m, off_deg = belief.error(robot)
        print(f'     its estimated pose is {off_m:.2f} m and {off_deg:.0f} degrees off')
        bad += not arrival.is_reached or arrival.distance_m > REACHED_M
    return bad


def _run(package: str, *arguments: str) -> None:
    subprocess.run(['ros2', 'run', package, *arguments], check=True, timeout=120.0)


if __name__ == '__main__':
    raise SystemExit(main())
