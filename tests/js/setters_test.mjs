// What is set of a body and a joint acts in the steps after it: node setters_test.mjs FOLDER
// SPDX-License-Identifier: MIT

import {check, done, equal, packaged, scalars, throws} from './checks.mjs';

const {load} = await packaged('isostep');
for (const scalar of scalars) {
  const iso = await load(scalar);
  const steps = (world, count) => {
    for (let i = 0; i < count; ++i) world.step();
  };
  const near = (found, expected, what) =>
    check(Math.abs(found - expected) < 0.01, `${scalar}: ${what}: ${found} instead of ${expected}`);

  // A body that grows keeps its mass and stays on its ground, the same each time.
  const world = iso.createWorld(), frame = world.createSnapshot();
  const large = world.addShape('box', {halfExtents: [1, 1, 1]});
  world.createBody({shape: world.addShape('half_space', {normal: [0, 1, 0]})});
  const crate = world.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
  const body = world.createBody({type: 'dynamic', shape: crate, position: [0, 0.5, 0]});
  steps(world, 60);
  const {mass} = world.bodyProperties(body);
  world.save(frame);
  const hashes = [0, 1].map(() => {
    world.load(frame);
    world.setShape(body, large);
    equal(world.bodyProperties(body).mass, mass, `${scalar}: its mass`);
    steps(world, 120);
    near(world.body(body).pose.position[1], 1, 'the grown crate');
    return world.hash;
  });
  equal(hashes[0], hashes[1], `${scalar}: a crate that grows again`);
  throws(() => world.setShape(body, large + (1n << 32n)), {field: 'shape', status: 1}, `${scalar}: a stale shape`);
  equal(world.hash, hashes[1], `${scalar}: a refused shape changes the world`);

  // A hinge goes where its motor, its limits and its spring drive it.
  const held = iso.createWorld();
  const cube = held.addShape('box', {halfExtents: [0.5, 0.5, 0.5]});
  const hinge = held.createJoint('hinge', {a: held.createBody({type: 'dynamic', shape: cube})});
  held.setMotor(hinge, 1, 100);
  steps(held, 60);
  near(held.jointPosition(hinge), 1, 'after a second of the motor');
  held.setLimits(hinge, -1.5, 1.25);
  steps(held, 60);
  near(held.jointPosition(hinge), 1.25, 'at the upper limit');
  held.setMotor(hinge, 0, 0);
  held.setSpring(hinge, 4, 1);
  held.setTarget(hinge, -0.5);
  steps(held, 60);
  near(held.jointPosition(hinge), -0.5, 'at the spring\'s target');
  const before = held.hash, tooFast = (scalar === 'f64' ? 2 ** 17 : 2 ** 14) + 1;  // beyond Limits::angular_speed()
  throws(() => held.setLimits(hinge, 1, 0), {field: 'lower', command: 'set_joint_limits'}, `${scalar}: limits`);
  throws(() => held.setMotor(hinge, tooFast, 1), {field: 'motor_speed'}, `${scalar}: a motor too fast`);
  throws(() => held.setSpring(hinge, 4, -1), {field: 'spring_damping'}, `${scalar}: damping below 0`);
  throws(() => held.setTarget(hinge, 7), {field: 'spring_target'}, `${scalar}: a target beyond a turn`);
  equal(held.hash, before, `${scalar}: a refused setter changes the world`);
}
done('shapes, limits, motors, springs and targets act once they are set');
