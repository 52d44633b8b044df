# SPDX-License-Identifier: Apache-2.0
"""
The humanoid in a physics simulator.

- `humanoid_simulation.model`: a world of robots and things, as MuJoCo wants it
- `humanoid_simulation.scene`: what is in the world besides robots
- `humanoid_simulation.backend`: the world as a backend of the controllers
- `humanoid_simulation.pacing`: how fast the time of the world passes
- `humanoid_simulation.disturbances`: ticks that a controller misses
"""
