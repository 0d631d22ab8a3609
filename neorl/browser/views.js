// What a frame shows of each world besides its scene: {radius (of things), body (of the agent), …}, in world sizes.

const [POINT, HULL] = [0.03, 0.035]; // the sizes at which agents are drawn that are points in their world

const onBoard = (side) => Math.min(1, Math.max(0, side)); // an obstacle at a side reaches beyond it

const VIEWS = {
  waterworld({ rules: { waterworld }, choices: { size } }) {
    return { radius: waterworld.radius / size, body: waterworld.radius / size };
  },
  arena({ rules: { arena } }) {
    const obstacles = Array.from(arena.obstacle, onBoard);
    return { radius: arena.radius, body: POINT, round: Boolean(arena.round), obstacles };
  },
  /** The tank shows joint space; `arm` has the links in the plane, with the base at the origin. */
  arm({ rules: { arm }, scene, world, world_state: { point } }) {
    let [x, y, angle] = [0, 0, 0];
    const links = Array.from(arm.length, (length, joint) => {
      angle += 2 * Math.PI * scene.position[joint];
      return { x: (x += length * Math.cos(angle)), y: (y += length * Math.sin(angle)) };
    });
    const points = Array.from(scene.kinds, (kind, i) =>
      ({ x: point[2 * i], y: point[2 * i + 1], kind: world.kinds[kind] }));
    return { radius: POINT, body: POINT, arm: { links, points, radius: arm.radius } };
  },
  water_maze({ rules: { water_maze: { radius } }, world_state: { platform, trial } }) {
    const [x, y] = platform;
    return { radius, body: POINT, round: true, hidden: { x, y, radius }, trial: Number(trial[0]) };
  },
  vessel({ rules, world_state: { heading } }) {
    return { radius: rules.radius, body: HULL, heading: Array.from(heading), current: Array.from(rules.current) };
  },
};

/** The velocities of a world's things, in world sizes per second. */
const MOTIONS = {
  waterworld: ({ world_state: { direction, speed }, choices: { size } }, i) =>
    [0, 1].map((axis) => (speed[i] * direction[2 * i + axis]) / size),
  vessel: ({ world_state: { course } }, i) => [0, 1].map((axis) => course[2 * i + axis]),
};

/** The things of a scene in the form in which they are drawn. */
function thingsOf(run) {
  const { scene, world, choices: { size } } = run;
  return Array.from(scene.kinds, (kind, i) => {
    const [vx, vy] = MOTIONS[world.name]?.(run, i) ?? [0, 0];
    return { x: scene.things[2 * i] / size, y: scene.things[2 * i + 1] / size, kind: world.kinds[kind], vx, vy };
  }).filter(({ kind }) => kind);
}

/** Action values as a vector: the sum of pushes times values; for a rudder, towards the side of the turn. */
function asVector({ choices: { push }, scene: { velocity } }, valueOf) {
  if (push.every((each) => each.every((along) => along === 0))) {
    const side = (valueOf(1) - valueOf(0)) / Math.hypot(...velocity);
    return [-side * velocity[1], side * velocity[0]];
  }
  return [0, 1].map((axis) => push.reduce((sum, along, action) =>
    (along[axis] ? sum + along[axis] * valueOf(action) : sum), 0));
}
