//! Bodies and holes: what falls in is not held by tiles, and not put back by the net.

use super::*;
use bevy_horizon::stamp::Rectangle;

#[test]
fn what_falls_into_a_hole_lies_on_the_cellars_floor() {
    let fallen = |mode: Mode| {
        let mut app = app(Place::ORIGIN, HorizonAvianPlugin::default());
        let bare = |world: HorizonQuery| world.height(Vec3::ZERO).unwrap();
        let level = 2.0 + app.world_mut().run_system_once(bare).unwrap();
        let at = StampPlace { place: Place::from_metres([0.0, level.into(), 0.0]), heading: 0.3 };
        let square = Rectangle { size: [4.0, 4.0], corner: 0.0 };
        app.world_mut().spawn((Stamp::new(Shape::Disc(Disc { radius: 12.0 }), Mode::Flatten), at));
        app.world_mut().spawn((Stamp::new(Shape::Rectangle(square), mode), at));
        app.update();
        let floor = Transform::from_xyz(0.0, level - 3.5, 0.0);
        app.world_mut().spawn((RigidBody::Static, Collider::cuboid(16.0, 1.0, 16.0), floor));
        // It goes on under the ground beside the hole.
        let pushed = (LinearVelocity(Vec3::X * 2.0), AngularDamping(1.0));
        let start = Transform::from_xyz(-0.5, level + 1.0, 0.0);
        let body = app.world_mut().spawn((RigidBody::Dynamic, Collider::sphere(RADIUS), start, pushed)).id();
        run(&mut app, 4 * SECOND);
        let position = app.world().get::<Position>(body).unwrap().0;
        (position.with_y(position.y - level), app.world().resource::<Seen>().lifted)
    };
    let (naive, _) = fallen(Mode::KeepTrees);
    let (ours, lifted) = fallen(Mode::Hole);
    println!("without a hole it lies at {naive}, with one at {ours}, over the plate; {lifted} lifts");
    assert!((naive.y - RADIUS).abs() < 0.05);
    assert!((ours.y + 3.0 - RADIUS).abs() < 0.05 && ours.x > 2.2 && lifted == 0);
}
