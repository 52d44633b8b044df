# SPDX-License-Identifier: Apache-2.0
"""
Gymnasium environments of the simulated humanoid; importing this package registers them.

- `humanoid_gym/Walk-v0`: walk at a commanded velocity
- `humanoid_gym/Stand-v0`: stand while something pushes
- `humanoid_gym/Reach-v0`: bring a gripper to a place, while the robot's own walk keeps the balance
"""

try:
    from gymnasium.envs.registration import register
except ImportError as error:
    raise ImportError(
        f'humanoid_gym needs the Python package gymnasium ({error}): install gymnasium, version 1 '
        'or later, and try again.',
        name='gymnasium',
    ) from error

WALK = 'humanoid_gym/Walk-v0'
STAND = 'humanoid_gym/Stand-v0'
REACH = 'humanoid_gym/Reach-v0'

register(WALK, entry_point='humanoid_gym.walk:WalkEnv', max_episode_steps=1000)
register(STAND, entry_point='humanoid_gym.stand:StandEnv', max_episode_steps=500)
register(REACH, entry_point='humanoid_gym.reach:ReachEnv', max_episode_steps=200)

__all__ = ['REACH', 'STAND', 'WALK']
