# SPDX-License-Identifier: Apache-2.0
"""
Example programs that drive and test a simulated robot.

- `walk_square`: walks around a square by odometry
- `push_test`: finds the strongest pushes that the robot withstands
- `record_gait`: records and plots a walk; needs no running simulator
"""
