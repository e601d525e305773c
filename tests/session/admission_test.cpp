// Who may play is for the host's game to say: before they come, by what they carry, and later by a kick.
// SPDX-License-Identifier: MIT
#include "session/admission_scene.hpp"

namespace isostep::test {
namespace admission_test {

// --- the game decides ---

SessionConfig asking(int players) {
  SessionConfig config = players_of(players);
  config.asks_admission = true;
  return config;
}
std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// A host's game with a list of those whom it lets in.
struct Lobby : OpenMatch {
  explicit Lobby(const SessionConfig& its_config) : OpenMatch(its_config) {
    match.host().after_turn = [this] {
      while (answers) {
        const std::optional<Applicant> applicant = host().poll_applicant();
        if (!applicant) break;
        seen.push_back(*applicant);
        credentials.emplace_back(applicant->credential.begin(), applicant->credential.end());
        if (credentials.back() == "invited") {
          EXPECT_TRUE(host().admit(applicant->id));
        } else {
          EXPECT_TRUE(host().refuse(applicant->id, "not invited"));
        }
      }
    };
  }
  SessionConfig carrying(std::string_view credential) const {
    SessionConfig its = client;
    its.credential = bytes_of(credential);
    return its;
  }
  bool answers = true;
  std::vector<Applicant> seen;
  std::vector<std::string> credentials;
};

TEST(Admission, IsByTheCredentialOfTheGamesLobby) {
  Lobby lobby(asking(2));
  Player& stranger = lobby.come(lobby.carrying("anybody"));
  EXPECT_EQ(lobby.refusal_of(stranger), "admission: not invited");
  EXPECT_EQ(stranger.session.phase(), SessionPhase::refused);
  EXPECT_EQ(lobby.match.host().last(Kind::refused).field.key.view(), "admission");
  Player& guest = lobby.come(lobby.carrying("invited"));
  EXPECT_TRUE(lobby.plays(guest, 2 * kSecond));
  EXPECT_EQ(lobby.credentials, (std::vector<std::string>{"anybody", "invited"}));
}

TEST(Admission, TheGameIsToldWhoAsks) {
  Lobby lobby(asking(3));
  SessionConfig spectator = lobby.carrying("invited");
  spectator.mode = SessionMode::spectator;
  lobby.come(spectator);
  lobby.pass(kSecond);
  SessionConfig second = lobby.carrying("invited");
  second.seat = 2;
  Player& owner = lobby.come(second);
  Player& other = lobby.come(lobby.carrying(std::string(kCredentialCap, 'x')));
  lobby.pass(kSecond);
  EXPECT_EQ(lobby.refusal_of(other), "admission: not invited");
  lobby.come(lobby.carrying("invited"));
  ASSERT_TRUE(lobby.plays(owner, 4 * kSecond));
  lobby.pass(kSecond);
  lobby.match.network().cut(owner.endpoint);
  lobby.pass(2 * kSecond);
  ASSERT_EQ(lobby.seen.size(), 5u);
  EXPECT_TRUE(lobby.seen[0].spectator);
  EXPECT_FALSE(lobby.seen[1].spectator);
  EXPECT_EQ(lobby.seen[1].seat, 2);
  EXPECT_EQ(lobby.seen[1].player, -1);
  EXPECT_EQ(lobby.seen[3].seat, -1);
  EXPECT_EQ(lobby.seen[4].player, 2) << "it has come back with its token";
  EXPECT_EQ(lobby.credentials[2].size(), kCredentialCap);
  for (std::size_t i = 1; i < lobby.seen.size(); ++i) EXPECT_NE(lobby.seen[i].id, lobby.seen[i - 1].id);
}

TEST(Admission, MayTakeItsTimeButNotForEver) {
  Lobby lobby(asking(2));
  lobby.answers = false;
  Player& guest = lobby.come(lobby.carrying("invited"));
  lobby.pass(4 * kSecond);
  EXPECT_EQ(guest.session.phase(), SessionPhase::waiting);
  EXPECT_EQ(lobby.host().stats().peers, 1);
  lobby.answers = true;
  EXPECT_TRUE(lobby.plays(guest, 2 * kSecond));

  Lobby mute(asking(2));
  mute.answers = false;
  Player& waits = mute.come(mute.carrying("invited"));
  waits.returns = false;
  mute.pass(6 * kSecond);
  EXPECT_EQ(waits.session.phase(), SessionPhase::lost);
  EXPECT_EQ(mute.host().stats().peers, 0);
}

TEST(Admission, OfWhoHasGoneIsNotThatOfWhoComesNext) {
  Lobby lobby(asking(2));
  lobby.answers = false;
  Player& gone = lobby.come(lobby.carrying("invited"));
  lobby.pass(kSecond);
  const std::optional<Applicant> first = lobby.host().poll_applicant();
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(lobby.host().poll_applicant().has_value()) << "each once";
  lobby.drop(gone);
  Player& next = lobby.come(lobby.carrying("anybody"));
  lobby.pass(kSecond);
  const std::optional<Applicant> second = lobby.host().poll_applicant();
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->peer, first->peer) << "the transport gives its number again";
  EXPECT_FALSE(lobby.host().admit(first->id));
  lobby.pass(kSecond);
  EXPECT_EQ(next.session.phase(), SessionPhase::waiting);
  EXPECT_FALSE(lobby.host().refuse(second->id, "two\nlines"));
  EXPECT_FALSE(lobby.host().refuse(second->id, std::string(kReplayValueCap + 1, 'x')));
  EXPECT_TRUE(lobby.host().refuse(second->id, std::string(kReplayValueCap, 'x')));
  EXPECT_FALSE(lobby.host().admit(second->id));
  EXPECT_EQ(lobby.refusal_of(next), "admission: " + std::string(kReplayValueCap, 'x'));
}

/// Its process started again without anything of the former one but what its lobby knows.
TEST(Admission, OfWhoLostItsTokenIsToItsOwnSeatAfterAKick) {
  Lobby lobby(asking(2));
  Player& former = lobby.come(lobby.carrying("invited"));
  ASSERT_TRUE(lobby.plays(former, 2 * kSecond));
  lobby.pass(kSecond);
  lobby.crash(former);
  lobby.answers = false;
  Player& again = lobby.come(lobby.carrying("invited"));
  std::optional<Applicant> applicant;
  lobby.match.run(kSecond, [&] { return (applicant = lobby.host().poll_applicant()).has_value(); });
  ASSERT_TRUE(applicant.has_value());
  EXPECT_EQ(applicant->player, -1);
  EXPECT_TRUE(lobby.host().kick(1, "comes again"));
  EXPECT_TRUE(lobby.host().admit(applicant->id));
  EXPECT_TRUE(lobby.plays(again, 2 * kSecond));
  EXPECT_EQ(again.session.local_player(), 1);
  EXPECT_EQ(lobby.host().peer_of(1), applicant->peer);
}

// --- seats ---

TEST(Seats, AreThoseThatWereAskedForOrNone) {
  OpenMatch scene(players_of(4));
  Player& third = scene.come(scene.with_seat(3));
  Player& first = scene.come(scene.with_seat(1));
  scene.pass(kSecond);
  Player& late = scene.come(scene.with_seat(3));
  EXPECT_EQ(scene.refusal_of(late), "seat: taken");
  EXPECT_EQ(late.last(Kind::refused).field.in_file.view(), "3");
  Player& hosts = scene.come(scene.with_seat(0));
  EXPECT_EQ(scene.refusal_of(hosts), "seat: taken");
  Player& any = scene.come();
  ASSERT_TRUE(scene.plays(any, 2 * kSecond));
  EXPECT_EQ(any.session.local_player(), 2);
  EXPECT_EQ(third.session.local_player(), 3);
  EXPECT_EQ(first.session.local_player(), 1);
  scene.pass(kSecond);
  scene.drop(third);
  scene.pass(kSecond);
  Player& again = scene.come(scene.with_seat(3));
  EXPECT_EQ(scene.refusal_of(again), "seat: reserved");
  Player& other = scene.come(scene.with_token(any.session.token()));
  EXPECT_TRUE(scene.plays(other, 2 * kSecond));
  SessionConfig both = scene.with_token(other.session.token());
  both.seat = 1;
  Player& undecided = scene.come(both);
  EXPECT_EQ(scene.refusal_of(undecided), "seat: another is yours");
}

TEST(Seats, AreLookedUpByTheirPlayers) {
  FullMatch scene(players_of(3));
  const std::optional<PeerId> first = scene.host().peer_of(1), second = scene.host().peer_of(2);
  ASSERT_TRUE(first && second);
  EXPECT_NE(*first, *second);
  for (const int nobody : {-1, 0, 3, 1000}) EXPECT_FALSE(scene.host().peer_of(nobody).has_value()) << nobody;
  scene.drop(scene.player(2));
  scene.pass(kSecond);
  EXPECT_FALSE(scene.host().peer_of(2).has_value());
  EXPECT_EQ(scene.host().peer_of(1), first);
}

// --- kicks ---

/// `left` of this player was told by all in the same frame.
void expect_left_alike(FullMatch& scene, int player, std::initializer_list<Player*> others) {
  const SessionEvent told = scene.match.host().last(Kind::left, player);
  EXPECT_NE(told.frame, kNoFrame);
  for (const Player* other : others) EXPECT_EQ(other->last(Kind::left, player).frame, told.frame);
}

TEST(Kick, EndsAPlayersPartInTheMatchAndTellsWhy) {
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    SessionConfig config = players_of(3);
    config.mode = mode;
    FullMatch scene(config);
    Player &kicked = scene.player(2), &stays = scene.player(1);
    const std::uint64_t token = kicked.session.token();
    const Frame before = scene.host().current();
    EXPECT_TRUE(scene.host().kick(2, "insults"));
    EXPECT_FALSE(scene.host().peer_of(2).has_value());
    scene.pass(kSecond);
    EXPECT_EQ(scene.refusal_of(kicked), "kicked: insults");
    EXPECT_EQ(kicked.session.phase(), SessionPhase::refused);
    EXPECT_TRUE(kicked.is_offline);
    EXPECT_GT(scene.host().current(), before + 55) << "nobody waits for it";
    expect_left_alike(scene, 2, {&stays});
    Player& again = scene.come(scene.with_token(token));
    const std::uint64_t refused = scene.host().stats().refused;
    EXPECT_TRUE(scene.plays(again, 2 * kSecond)) << "as anybody: whom it lets in is for the game to say";
    EXPECT_EQ(scene.host().stats().refused, refused + 1) << "the token is void";
    EXPECT_EQ(again.session.local_player(), 2);
    scene.pass(kSecond);
    expect_one_history(scene.match);
  }
}

TEST(Kick, FreesTheSeatOfWhoIsAway) {
  FullMatch scene(players_of(2));
  scene.drop(scene.player(1));
  scene.pass(kSecond);
  EXPECT_EQ(scene.refusal_of(scene.come()), "seats: reserved");
  EXPECT_TRUE(scene.host().kick(1, "away"));
  EXPECT_FALSE(scene.host().kick(1, "away")) << "nobody's";
  EXPECT_TRUE(scene.plays(scene.come(), 2 * kSecond));
}

TEST(Kick, IsOfSpectatorsByTheirConnection) {
  FullMatch scene(players_of(2));
  Player& watcher = scene.come(scene.as_spectator());
  scene.pass(kSecond);
  ASSERT_EQ(watcher.session.phase(), SessionPhase::watching);
  const PeerId peer = scene.host().peer_of(1) == PeerId{0} ? 1 : 0;
  EXPECT_FALSE(scene.host().kick_peer(40, "nobody"));
  EXPECT_FALSE(scene.host().kick_peer(9999, "nobody"));
  EXPECT_TRUE(scene.host().kick_peer(peer, "the match is private"));
  EXPECT_EQ(scene.refusal_of(watcher), "kicked: the match is private");
  EXPECT_TRUE(scene.host().kick_peer(*scene.host().peer_of(1), "and so is this"));
  EXPECT_EQ(scene.refusal_of(scene.player(1)), "kicked: and so is this");
  scene.pass(kSecond);
  EXPECT_TRUE(scene.match.host().heard(Kind::left, 1));
}

TEST(Kick, FreesTheSeatBeforeTheMatchBeginsToo) {
  OpenMatch scene(players_of(3));
  Player& kicked = scene.come(scene.with_seat(1));
  scene.pass(kSecond);
  EXPECT_TRUE(scene.host().kick(1, "not yet"));
  EXPECT_EQ(scene.refusal_of(kicked), "kicked: not yet");
  Player &first = scene.come(scene.with_seat(1)), &second = scene.come(scene.with_seat(2));
  EXPECT_TRUE(scene.plays(first, 2 * kSecond));
  EXPECT_TRUE(scene.plays(second, 2 * kSecond));
  scene.pass(kSecond);
  EXPECT_EQ(scene.match.host().last(Kind::joined, 1).frame, 0);
}

TEST(Kick, NeedsAPlayerAndAReasonThatCanBeRead) {
  FullMatch scene(players_of(2));
  EXPECT_FALSE(scene.host().kick(0, "the host itself"));
  EXPECT_FALSE(scene.host().kick(-1, "nobody"));
  EXPECT_FALSE(scene.host().kick(2, "nobody"));
  EXPECT_FALSE(scene.host().kick(1, "\x1b[2J"));
  EXPECT_FALSE(scene.host().kick(1, std::string(kReplayValueCap + 1, 'x')));
  EXPECT_FALSE(scene.player(1).session.kick(0, "a client kicks nobody"));
  EXPECT_TRUE(scene.host().peer_of(1).has_value());
  EXPECT_TRUE(scene.host().kick(1, ""));
}

}  // namespace admission_test
}  // namespace isostep::test
