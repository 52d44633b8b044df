# SPDX-License-Identifier: Apache-2.0
"""Setup script of the package."""

from setuptools import find_packages, setup

package_name = 'tf_transformations'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', [f'resource/{package_name}']),
        (f'share/{package_name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    author='Humanoid workspace maintainers',
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Rotations, quaternions and homogeneous matrices.',
    license='Apache-2.0',
    tests_require=['pytest'],
)
