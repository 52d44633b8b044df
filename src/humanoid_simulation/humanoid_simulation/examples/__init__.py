# SPDX-License-Identifier: Apache-2.0
"""
Programs that show how a simulated robot is driven and tested.

- `walk_square`: walks round a square by odometry
- `push_test`: finds out which pushes the robot stands
- `record_gait`: draws how the robot walks; needs no simulator that runs
"""
