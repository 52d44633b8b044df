# SPDX-License-Identifier: Apache-2.0
"""
Simulation of the humanoid in MuJoCo.

- `humanoid_simulation.model`: MuJoCo models of worlds with robots and objects
- `humanoid_simulation.scene`: floor, objects and all else in a world besides robots
- `humanoid_simulation.backend`: the simulation as a backend of the controllers
- `humanoid_simulation.pacing`: the real-time factor of the simulation
"""
