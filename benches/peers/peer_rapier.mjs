// Rapier in Node: a stage as JSON on the standard input, the states as JSON on the standard output.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

// One body: circles or a box; its mass and its moment of inertia are told, not made of the shape's density.
function add(rapier, world, ground, stage, piece) {
    const [x, y, angle, vx, vy, omega] = piece.start;
    const body = world.createRigidBody(
        rapier.RigidBodyDesc.dynamic()
            .setTranslation(x, y)
            .setRotation(angle)
            .setLinvel(vx, vy)
            .setAngvel(omega)
            .setCanSleep(stage.sleeps)
            .setAdditionalMassProperties(piece.mass, { x: 0, y: 0 }, piece.inertia),
    );
    const circle = (foot) => rapier.ColliderDesc.ball(piece.radius).setTranslation(foot, 0);
    const box = ([width, height]) => rapier.ColliderDesc.cuboid(width / 2, height / 2);
    const shapes = piece.box.length ? [box(piece.box)] : piece.feet.map(circle);
    for (const shape of shapes) {
        world.createCollider(
            shape.setDensity(0).setFriction(stage.friction).setRestitution(stage.restitution),
            body,
        );
    }
    if (piece.hook) {
        const hook = { x: x - piece.hook * Math.sin(angle), y: y + piece.hook * Math.cos(angle) };
        const joint = rapier.JointData.revolute(hook, { x: 0, y: piece.hook });
        world.createImpulseJoint(joint, ground, body, true);
    }
    return body;
}

function build(rapier, stage) {
    const world = new rapier.World({ x: 0, y: -stage.gravity });
    world.timestep = stage.step;
    const ground = world.createRigidBody(rapier.RigidBodyDesc.fixed());
    if (stage.floor !== null) {
        const floor = rapier.ColliderDesc.halfspace({ x: -Math.sin(stage.slope), y: Math.cos(stage.slope) });
        // Of two coefficients the mean counts, so both have them.
        floor.setTranslation(0, stage.floor).setFriction(stage.friction).setRestitution(stage.restitution);
        world.createCollider(floor, ground);
    }
    return { world, bodies: stage.pieces.map((piece) => add(rapier, world, ground, stage, piece)) };
}

// The engine tells angles between -pi and pi: turns are counted.
function unwound(before, angle) {
    return before + Math.atan2(Math.sin(angle - before), Math.cos(angle - before));
}

function states(bodies, before) {
    return bodies.map((body, number) => {
        const [at, v] = [body.translation(), body.linvel()];
        return [at.x, at.y, unwound(before[number][2], body.rotation()), v.x, v.y, body.angvel()];
    });
}

function run(rapier, stage) {
    const marks = new Set(stage.marks);
    const { world, bodies } = build(rapier, stage);
    let now = stage.pieces.map((piece) => piece.start);
    const [found, path] = [marks.has(0) ? { 0: now } : {}, []];
    for (let count = 1; count <= stage.steps; count += 1) {
        world.step();
        now = states(bodies, now);
        path.push(now[0]);
        if (marks.has(count)) found[count] = now;
    }
    world.free();
    return { found, path };
}

const [modules] = process.argv.slice(2);
const rapier = createRequire(modules)("@dimforge/rapier2d-compat");
// It warns of the way it calls itself.
const warn = console.warn;
console.warn = () => {};
await rapier.init();
console.warn = warn;
const stage = JSON.parse(readFileSync(0, "utf8"));
let best = null;
// As the other tools: the least of three runs, where they are short.
for (let spent = 0, tries = 0; tries < 3 && spent < 1; tries += 1) {
    const begin = process.cpuUsage();
    const result = run(rapier, stage);
    const { user, system } = process.cpuUsage(begin);
    const seconds = (user + system) / 1e6;
    spent += seconds;
    if (best === null || seconds < best.seconds) best = { ...result, seconds };
}
process.stdout.write(JSON.stringify({ version: rapier.version(), ...best }));
