# SPDX-License-Identifier: Apache-2.0
"""
A robot without physics: it moves exactly as it is told, and sees the map.

With `speed` above 1, simulated time on /clock runs faster than the computer's: each tick of
`update_duration` simulated seconds takes `update_duration / speed` real ones. All other nodes need
`use_sim_time`. Choose `update_duration` so that there are at most some 200 ticks in a real second,
such as 0.05 at speed 10. If the process is busy, ticks are late and time waits: nothing is lost.
"""
