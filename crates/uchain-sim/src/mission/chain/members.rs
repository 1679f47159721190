//! Who is in the chain: ids are for life, the order is a list that changes.

/// What a UAV is about, seen from the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Member {
    /// On the ground, and has not flown since it joined: it takes off when it is its turn.
    Waiting,
    /// In the air, and a link of the chain.
    Flying,
    /// On the ground again. If its brain asks to fly once more, it is a link of the chain again.
    Landed,
    /// It has failed for good.
    Failed,
}

/// Why the list was not changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MemberError {
    /// No such UAV.
    #[error("there is no UAV {uav}: there are {uavs}, from 0")]
    Unknown {
        /// Its id.
        uav: usize,
        /// How many there are.
        uavs: usize,
    },
    /// It has a place already.
    #[error("UAV {uav} is in the chain already, in place {place}; it has to leave first")]
    Joined {
        /// Its id.
        uav: usize,
        /// Its place.
        place: u16,
    },
    /// It has none.
    #[error("UAV {uav} is not in the chain")]
    Left {
        /// Its id.
        uav: usize,
    },
    /// It has failed.
    #[error("UAV {uav} has failed for good")]
    Failed {
        /// Its id.
        uav: usize,
    },
    /// No such place.
    #[error("there is no place {place} in a chain of {members}; expected 0 to {members}")]
    Place {
        /// What was asked for.
        place: usize,
        /// How many have a place.
        members: usize,
    },
}

/// Order and state of all UAVs. Place 0 leads the chain, and the last one is nearest to the base. Those that wait and those
/// that have failed keep their places: neighbours of a link are the nearest two in the air.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Members {
    /// Ids, by place.
    order: Vec<usize>,
    /// Places, by id.
    places: Vec<Option<u16>>,
    /// By id.
    by_id: Vec<Member>,
    /// Ids of those in the air, in order.
    flying: Vec<usize>,
}

impl Members {
    /// So many UAVs that wait, in order of their ids.
    pub(super) fn new(uavs: usize) -> Self {
        let mut members = Self {
            order: Vec::with_capacity(uavs),
            places: Vec::with_capacity(uavs),
            by_id: Vec::with_capacity(uavs),
            flying: Vec::with_capacity(uavs),
        };
        members.reset(uavs);
        members
    }

    /// As [`Members::new`] makes it.
    pub(super) fn reset(&mut self, uavs: usize) {
        self.order.clear();
        self.order.extend(0..uavs);
        self.by_id.clear();
        self.by_id.resize(uavs, Member::Waiting);
        self.list();
    }

    /// Ids by place, the leader first.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// Ids of those in the air that have a place, the leader first.
    pub fn flying(&self) -> &[usize] {
        &self.flying
    }

    /// What a UAV is about; `None` if there is none of this id.
    pub fn member(&self, uav: usize) -> Option<Member> {
        self.by_id.get(uav).copied()
    }

    /// A UAV's place; `None` if it has none.
    pub fn place_of(&self, uav: usize) -> Option<u16> {
        self.places.get(uav).copied().flatten()
    }

    /// Who leads the chain: it has a pilot. `None` of an empty list.
    pub fn leader(&self) -> Option<usize> {
        self.order.first().copied()
    }

    /// Who is in the air and nearest to a place, on the leader's side.
    pub(super) fn ahead_of(&self, place: u16) -> Option<usize> {
        self.flying.iter().copied().rev().find(|&uav| self.places[uav] < Some(place))
    }

    /// Whose turn it is to take off: the first that waits. It listens from the ground.
    pub fn in_line(&self) -> Option<usize> {
        self.order.iter().copied().find(|&uav| self.by_id[uav] == Member::Waiting)
    }

    /// Puts a UAV into the list: who had this place, and all behind, are one farther from the leader.
    pub(super) fn join(&mut self, uav: usize, place: usize) -> Result<(), MemberError> {
        match self.known(uav)? {
            Member::Failed => return Err(MemberError::Failed { uav }),
            Member::Landed => self.by_id[uav] = Member::Waiting,
            Member::Waiting | Member::Flying => {}
        }
        if let Some(place) = self.place_of(uav) {
            return Err(MemberError::Joined { uav, place });
        }
        if place > self.order.len() {
            return Err(MemberError::Place { place, members: self.order.len() });
        }
        self.order.insert(place, uav);
        self.list();
        Ok(())
    }

    /// Takes a UAV off the list; it flies on, if it does, as nobody's neighbour.
    pub(super) fn leave(&mut self, uav: usize) -> Result<(), MemberError> {
        self.known(uav)?;
        let place = self.place_of(uav).ok_or(MemberError::Left { uav })?;
        self.order.remove(usize::from(place));
        self.list();
        Ok(())
    }

    fn known(&self, uav: usize) -> Result<Member, MemberError> {
        self.member(uav).ok_or(MemberError::Unknown { uav, uavs: self.by_id.len() })
    }

    /// A UAV has failed; whether it was in the air.
    pub(super) fn fail(&mut self, uav: usize) -> bool {
        let was_flying = self.by_id[uav] == Member::Flying;
        self.by_id[uav] = Member::Failed;
        if was_flying {
            self.list_flying();
        }
        was_flying
    }

    /// Who is in the air from now on, by id.
    pub(super) fn fly(&mut self, airborne: impl Iterator<Item = bool>) {
        let mut has_changed = false;
        for (member, airborne) in self.by_id.iter_mut().zip(airborne) {
            let now = match (*member, airborne) {
                (Member::Failed, _) => Member::Failed,
                (_, true) => Member::Flying,
                (Member::Flying, false) => Member::Landed,
                (member, false) => member,
            };
            has_changed |= now != *member;
            *member = now;
        }
        if has_changed {
            self.list_flying();
        }
    }

    fn list(&mut self) {
        self.places.clear();
        self.places.resize(self.by_id.len(), None);
        for (place, &uav) in self.order.iter().enumerate() {
            self.places[uav] = u16::try_from(place).ok();
        }
        self.list_flying();
    }

    fn list_flying(&mut self) {
        let by_id = &self.by_id;
        self.flying.clear();
        self.flying.extend(self.order.iter().copied().filter(|&uav| by_id[uav] == Member::Flying));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_joins_gets_a_place_and_who_leaves_leaves_none_behind() {
        let mut members = Members::new(4);
        members.fly([true, true, false, true].into_iter());
        assert_eq!((members.flying(), members.in_line()), (&[0, 1, 3][..], Some(2)));
        members.leave(1).unwrap();
        assert_eq!((members.order(), members.flying()), (&[0, 2, 3][..], &[0, 3][..]));
        assert_eq!((members.place_of(1), members.place_of(3)), (None, Some(2)));
        members.join(1, 0).unwrap();
        assert_eq!((members.leader(), members.flying()), (Some(1), &[1, 0, 3][..]));
        assert_eq!(members.member(1), Some(Member::Flying));
    }

    #[test]
    fn who_has_landed_waits_in_line_again_once_it_has_left_and_joined() {
        let mut members = Members::new(2);
        members.fly([true, true].into_iter());
        members.fly([true, false].into_iter());
        assert_eq!((members.member(1), members.in_line()), (Some(Member::Landed), None));
        members.leave(1).unwrap();
        members.join(1, 1).unwrap();
        assert_eq!((members.member(1), members.in_line()), (Some(Member::Waiting), Some(1)));
    }

    #[test]
    fn a_wrong_id_or_place_is_refused_with_its_numbers_and_changes_nothing() {
        let mut members = Members::new(2);
        let before = members.clone();
        assert_eq!(members.join(2, 0), Err(MemberError::Unknown { uav: 2, uavs: 2 }));
        assert_eq!(members.join(1, 0), Err(MemberError::Joined { uav: 1, place: 1 }));
        assert_eq!(members, before);
        members.leave(1).unwrap();
        assert_eq!(members.leave(1), Err(MemberError::Left { uav: 1 }));
        assert_eq!(members.join(1, 2), Err(MemberError::Place { place: 2, members: 1 }));
        members.fail(1);
        assert_eq!(members.join(1, 0), Err(MemberError::Failed { uav: 1 }));
        assert_eq!((members.order(), members.leader()), (&[0][..], Some(0)));
    }
}
