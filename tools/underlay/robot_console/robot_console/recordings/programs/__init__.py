# SPDX-License-Identifier: Apache-2.0
"""
Programs that the console runs as child processes, so that the page never blocks on them.

Each exits in order when its standard input is closed. Therefore, none outlives the console, even
if that is killed.
"""
