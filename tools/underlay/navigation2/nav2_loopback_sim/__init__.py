# SPDX-License-Identifier: Apache-2.0
"""
Loopback simulator: a robot that follows commands exactly, with a simulated laser.

With `speed` above 1, simulated time on /clock runs faster than real time: each tick of
`update_duration` simulated seconds takes `update_duration / speed` real ones. All other nodes need
`use_sim_time`. Choose `update_duration` so that there are at most about 200 ticks per real second,
such as 0.05 at speed 10. If the process is busy, ticks are late and time is delayed: no tick is
lost.
"""
