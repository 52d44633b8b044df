# SPDX-License-Identifier: Apache-2.0
"""
Programs that the console starts beside itself, so that the page never waits for them.

Each ends by itself, and in order, when its standard input is closed. So none outlives the console,
even if that is killed.
"""
