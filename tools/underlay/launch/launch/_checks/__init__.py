# SPDX-License-Identifier: Apache-2.0
"""
Say what is wrong before the start.

`before_start` runs the checks between the first visit and the first process, and `programs`
explains which program is not there.
"""
