# SPDX-License-Identifier: Apache-2.0
"""An action server that computes the Fibonacci sequence, and a client for it."""
