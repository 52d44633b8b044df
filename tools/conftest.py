# SPDX-License-Identifier: Apache-2.0
"""
What all tests of tools/ need: that Ctrl-C works in the processes which they start.

A shell that starts the tests in the background lets them ignore it, and all that they start.
"""

import signal

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
