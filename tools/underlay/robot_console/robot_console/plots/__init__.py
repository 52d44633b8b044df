# SPDX-License-Identifier: Apache-2.0
"""Which numbers of messages are plotted, and what is kept and drawn of them; without ROS."""
