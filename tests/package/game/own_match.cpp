// A session outside the tree: a game of orders is rolled back at every frame and gives the same states again.
// SPDX-License-Identifier: MIT
#include <isostep/session/session.hpp>
#include <isostep/state/composite.hpp>
#include <isostep/world/world.hpp>

namespace iso = isostep;
using S = iso::Q32_32;

struct Order {
  std::uint8_t height = 0;
  friend bool operator==(Order, Order) = default;
  ISO_FIELDS(height)
};

struct Orders {  // how many were carried out
  std::uint32_t count = 0;
  ISO_FIELDS(count)
};

struct Game : iso::Composite<iso::World<S>, Orders> {
  using Input = iso::CommandList<Order, 4>;
  iso::ShapeId ball;

  Game() {
    world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    ball = world.add_shape(iso::Sphere{0.5});
  }
  void step(iso::InputView<Input> inputs) {
    for (const Input& orders : inputs.values) {
      for (const Order& order : orders) {
        world.create({.type = iso::dynamic, .shape = ball, .position = {0, S(order.height), 0}});
        ++user.count;
      }
    }
    world.step();
  }
};

int main() {
  Game game;
  iso::SessionConfig config;
  config.mode = iso::SessionMode::sync_test;
  iso::Session<Game> session(config);
  iso::Time now = 0;
  for (; session.confirmed() < 120 && now < 10 * iso::kSecond; now += session.wait(now) + 1) {
    Game::Input orders;
    if (session.current() % 20 == 0) orders.add({static_cast<std::uint8_t>(2 + session.current() / 20)});
    session.add_local_input(0, orders);
    iso::drive(session, game, now);
    if (session.poll_event()) return 1;
  }
  return session.confirmed() >= 120 && game.world.counts().bodies == 1 + game.user.count && game.user.count > 5 &&
                 session.stats().rollbacks[8] > 3
             ? 0
             : 1;
}
